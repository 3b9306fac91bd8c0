// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// What the mesh file's writer and reader both need of HDF5: an owner for its handles, silence, and the layout of our
/// element types. Header only: a user of the library that does not include it needs no HDF5.
/// The HDF5 library is not thread-safe as Debian builds it: one mesh file at a time.
#pragma once

#include <hdf5.h>

#include <array>
#include <cstdint>
#include <string>
#include <utility>

#include "model/mesh.h"

namespace wellknit::hdf5 {

/// Owns an identifier of the HDF5 library; closed when it goes. Negative: the call that made it failed.
class Handle {
 public:
  using Close = herr_t (*)(hid_t);
  Handle(hid_t id, Close closer) : id_(id), close_(closer) {}
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  Handle& operator=(Handle&&) = delete;
  ~Handle() { close(); }

  [[nodiscard]] hid_t get() const { return id_; }
  [[nodiscard]] bool is_valid() const { return id_ >= 0; }
  /// Closes now; false when that failed (data that could not be flushed).
  bool close() { return id_ < 0 || close_(std::exchange(id_, -1)) >= 0; }

 private:
  hid_t id_;
  Close close_;
};

/// Keeps the HDF5 library from printing its error stack while it lives; the errors become exceptions of ours.
class Silence {
 public:
  Silence() {
    // At the end of the program the library closes what it could not close before, and after a write that failed (a
    // full disk) it crashes there. We close all handles ourselves. Only before its first use can it be told so.
    static const herr_t without_clean_up = H5dont_atexit();
    (void)without_clean_up;
    H5Eget_auto2(H5E_DEFAULT, &function_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  ~Silence() { H5Eset_auto2(H5E_DEFAULT, function_, data_); }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

 private:
  H5E_auto2_t function_ = nullptr;
  void* data_ = nullptr;
};

/// How an element of one of our arrays lies in memory and in the file: `columns` numbers of one type.
/// columns 1 makes a dataset [n], more make [n, columns].
struct Element {
  hid_t memory_type;
  hid_t file_type;
  hsize_t columns;
};

inline Element element(const double*) { return {H5T_NATIVE_DOUBLE, H5T_IEEE_F64LE, 1}; }
inline Element element(const std::uint8_t*) { return {H5T_NATIVE_UINT8, H5T_STD_U8LE, 1}; }
inline Element element(const std::int64_t*) { return {H5T_NATIVE_INT64, H5T_STD_I64LE, 1}; }
inline Element element(const std::int32_t*) { return {H5T_NATIVE_INT32, H5T_STD_I32LE, 1}; }
inline Element element(const std::array<std::int32_t, 2>*) { return {H5T_NATIVE_INT32, H5T_STD_I32LE, 2}; }
inline Element element(const Vec3*) { return {H5T_NATIVE_DOUBLE, H5T_IEEE_F64LE, 3}; }
inline Element element(const std::array<double, 2>*) { return {H5T_NATIVE_DOUBLE, H5T_IEEE_F64LE, 2}; }
inline Element element(const std::array<double, 4>*) { return {H5T_NATIVE_DOUBLE, H5T_IEEE_F64LE, 4}; }
inline Element element(const CellKind*) { return {H5T_NATIVE_UINT8, H5T_STD_U8LE, 1}; }
inline Element element(const ConnectionKind*) { return {H5T_NATIVE_UINT8, H5T_STD_U8LE, 1}; }
inline Element element(const RadialIndex*) { return {H5T_NATIVE_INT32, H5T_STD_I32LE, 3}; }
/// An id has 32 bits in memory and 64 in the file; "none" is -1 in both. A larger one in a file becomes the largest of
/// 32 bits, which names nothing.
template <class Tag>
Element element(const Id<Tag>*) {
  return {H5T_NATIVE_INT32, H5T_STD_I64LE, 1};
}
template <class Tag>
Element element(const std::array<Id<Tag>, 2>*) {
  return {H5T_NATIVE_INT32, H5T_STD_I64LE, 2};
}
/// Wells are few: the file keeps 32 bits a cell for them.
inline Element element(const WellId*) { return {H5T_NATIVE_INT32, H5T_STD_I32LE, 1}; }

static_assert(sizeof(Vec3) == 3 * sizeof(double) && sizeof(RadialIndex) == 3 * sizeof(std::int32_t) &&
              sizeof(std::array<CellId, 2>) == 2 * sizeof(std::int32_t));

/// Schema names that both sides use.
inline constexpr const char* schema_name = "wellknit-mesh";
inline constexpr const char* schema_version = "1.0";

/// A string type of fixed length, UTF-8, padded with zero bytes. Not the variable-length one: HDF5 keeps those strings
/// in heaps without checksums and crashes on damaged ones.
inline Handle string_type(std::size_t length) {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type.get(), length);
  H5Tset_cset(type.get(), H5T_CSET_UTF8);
  H5Tset_strpad(type.get(), H5T_STR_NULLPAD);
  return type;
}

}  // namespace wellknit::hdf5
