// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Preloaded into tests and the programs that they start, this notes what they say: the text of each error of ours
/// that is thrown, and the pattern of each text that fmt puts together. A line each in a file of the process, in the
/// folder WELLKNIT_MESSAGES; tests/messages/check_messages.py compares them with docs/messages.md.

#include <dlfcn.h>
#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <ostream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <typeinfo>
#include <unordered_set>

namespace {

/// Never destroyed: programs throw and format while they end.
class Log {
 public:
  static Log& instance() {
    static Log* const log = new Log;
    return *log;
  }

  void add(std::string line) {
    for (char& c : line)
      if (c == '\n') c = ' ';
    const std::lock_guard lock(mutex_);
    if (!seen_.insert(line).second) return;
    // A forked child writes to a file of its own.
    const pid_t process = getpid();
    if (process != process_) open(process);
    if (file_ == nullptr) return;
    line += '\n';
    std::fwrite(line.data(), 1, line.size(), file_);
    std::fflush(file_);  // a test may end the process at any time
  }

 private:
  void open(pid_t process) {
    process_ = process;
    const char* const folder = std::getenv("WELLKNIT_MESSAGES");
    file_ =
        folder == nullptr ? nullptr : std::fopen((std::string(folder) + "/" + std::to_string(process)).c_str(), "a");
  }

  std::mutex mutex_;
  std::unordered_set<std::string> seen_;
  pid_t process_ = -1;
  std::FILE* file_ = nullptr;
};

}  // namespace

namespace {

/// Lines with a few words in them; runs of digits are one.
void add_lines(std::string_view text) {
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string line = "printed\t";
    for (const char c : text.substr(0, end))
      if (std::isdigit(static_cast<unsigned char>(c)) == 0)
        line += c;
      else if (line.back() != '#')
        line += '#';
    if (std::count(line.begin(), line.end(), ' ') > 2) Log::instance().add(std::move(line));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
}

}  // namespace

// The names and the types of what is replaced are those of the C++ runtime and of fmt.
extern "C" [[noreturn, gnu::visibility("default")]] void __cxa_throw(void* object, void* type, void (*destroy)(void*)) {
  using Throw = void (*)(void*, void*, void (*)(void*));
  static const auto real = reinterpret_cast<Throw>(dlsym(RTLD_NEXT, "__cxa_throw"));
  const std::string_view name = static_cast<const std::type_info*>(type)->name();
  for (const std::string_view ours : {"ParseError", "InvalidInput", "UsageError", "WriteError"})
    if (name.find("wellknit") != std::string_view::npos && name.find(ours) != std::string_view::npos)
      Log::instance().add(std::string(ours) + "\t" + static_cast<std::runtime_error*>(object)->what());
  real(object, type, destroy);
  std::abort();
}

FMT_BEGIN_NAMESPACE
[[gnu::visibility("default")]] std::string vformat(string_view pattern, format_args arguments) {
  using Format = std::string (*)(string_view, format_args);
  static const auto real = reinterpret_cast<Format>(
      dlsym(RTLD_NEXT,
            "_ZN3fmt2v97vformatB5cxx11ENS0_17basic_string_viewIcEENS0_17basic_format_argsINS0_20basic_"
            "format_contextINS0_8appenderEcEEEE"));
  Log::instance().add("pattern\t" + std::string(pattern.data(), pattern.size()));
  return real(pattern, arguments);
}
FMT_END_NAMESPACE

// std::__ostream_insert<char>, that all text goes through.
[[gnu::visibility("default")]] std::ostream& insert(std::ostream& out, const char* text, std::streamsize size) asm(
    "_ZSt16__ostream_insertIcSt11char_traitsIcEERSt13basic_ostreamIT_T0_ES6_PKS3_l");
std::ostream& insert(std::ostream& out, const char* text, std::streamsize size) {
  using Insert = std::ostream& (*)(std::ostream&, const char*, std::streamsize);
  static const auto real = reinterpret_cast<Insert>(
      dlsym(RTLD_NEXT, "_ZSt16__ostream_insertIcSt11char_traitsIcEERSt13basic_ostreamIT_T0_ES6_PKS3_l"));
  add_lines({text, static_cast<std::size_t>(size)});
  return real(out, text, size);
}
