! SPDX-FileCopyrightText: 2026 The wellknit authors
! SPDX-License-Identifier: GPL-3.0-or-later

!> wellknit.h for Fortran 2003 and later. Compile it with your program and link libwellknit. Arrays come as pointers
!> into the model: they have the mesh file's columns as their first dimension, and indices in them begin at 0.
module wellknit
  use, intrinsic :: iso_c_binding
  implicit none
  private
  public :: wellknit_open_case, wellknit_add_trajectory, wellknit_add_deck_wells, wellknit_set, wellknit_build, &
            wellknit_read_mesh, wellknit_write, wellknit_well_count, wellknit_free_request, wellknit_free_model, &
            wellknit_last_error, wellknit_reals, wellknit_integers

  integer(c_int), parameter :: float64 = 0, int32 = 2

  type, bind(c) :: view
    type(c_ptr) :: data
    integer(c_int64_t) :: rows, columns
    integer(c_int32_t) :: type
  end type

  interface
    function c_open_case(path) bind(c, name="wellknit_open_case") result(request)
      import :: c_ptr, c_char
      character(kind=c_char), intent(in) :: path(*)
      type(c_ptr) :: request
    end function
    function c_add_trajectory(request, path, options) bind(c, name="wellknit_add_trajectory") result(status)
      import :: c_ptr, c_char, c_int
      type(c_ptr), value :: request, options
      character(kind=c_char), intent(in) :: path(*)
      integer(c_int) :: status
    end function
    function c_add_deck_wells(request, names, options) bind(c, name="wellknit_add_deck_wells") result(status)
      import :: c_ptr, c_char, c_int
      type(c_ptr), value :: request, options
      character(kind=c_char), intent(in) :: names(*)
      integer(c_int) :: status
    end function
    function c_set(request, option, text) bind(c, name="wellknit_set") result(status)
      import :: c_ptr, c_char, c_int
      type(c_ptr), value :: request
      character(kind=c_char), intent(in) :: option(*), text(*)
      integer(c_int) :: status
    end function
    !> A null pointer where it fails.
    function wellknit_build(request) bind(c, name="wellknit_build") result(model)
      import :: c_ptr
      type(c_ptr), value :: request
      type(c_ptr) :: model
    end function
    function c_read_mesh(path) bind(c, name="wellknit_read_mesh") result(model)
      import :: c_ptr, c_char
      character(kind=c_char), intent(in) :: path(*)
      type(c_ptr) :: model
    end function
    function c_write(model, path, format, overwrite) bind(c, name="wellknit_write") result(status)
      import :: c_ptr, c_char, c_int
      type(c_ptr), value :: model
      character(kind=c_char), intent(in) :: path(*), format(*)
      integer(c_int), value :: overwrite
      integer(c_int) :: status
    end function
    function c_array(model, name, found) bind(c, name="wellknit_array") result(status)
      import :: c_ptr, c_char, c_int, view
      type(c_ptr), value :: model
      character(kind=c_char), intent(in) :: name(*)
      type(view), intent(out) :: found
      integer(c_int) :: status
    end function
    function wellknit_well_count(model) bind(c, name="wellknit_well_count") result(count)
      import :: c_ptr, c_int64_t
      type(c_ptr), value :: model
      integer(c_int64_t) :: count
    end function
    subroutine wellknit_free_request(request) bind(c, name="wellknit_free_request")
      import :: c_ptr
      type(c_ptr), value :: request
    end subroutine
    subroutine wellknit_free_model(model) bind(c, name="wellknit_free_model")
      import :: c_ptr
      type(c_ptr), value :: model
    end subroutine
    function c_last_error() bind(c, name="wellknit_last_error") result(text)
      import :: c_ptr
      type(c_ptr) :: text
    end function
    function c_strlen(text) bind(c, name="strlen") result(length)
      import :: c_ptr, c_size_t
      type(c_ptr), value :: text
      integer(c_size_t) :: length
    end function
  end interface

contains

  !> A null pointer where it fails.
  function wellknit_open_case(path) result(request)
    character(*), intent(in) :: path
    type(c_ptr) :: request
    request = c_open_case(trim(path) // c_null_char)
  end function

  !> .false. where it fails. The radial meshes have the defaults.
  logical function wellknit_add_trajectory(request, path)
    type(c_ptr), intent(in) :: request
    character(*), intent(in) :: path
    wellknit_add_trajectory = c_add_trajectory(request, trim(path) // c_null_char, c_null_ptr) == 0
  end function

  logical function wellknit_add_deck_wells(request, names)
    type(c_ptr), intent(in) :: request
    character(*), intent(in) :: names
    wellknit_add_deck_wells = c_add_deck_wells(request, trim(names) // c_null_char, c_null_ptr) == 0
  end function

  logical function wellknit_set(request, option, text)
    type(c_ptr), intent(in) :: request
    character(*), intent(in) :: option, text
    wellknit_set = c_set(request, trim(option) // c_null_char, trim(text) // c_null_char) == 0
  end function

  function wellknit_read_mesh(path) result(model)
    character(*), intent(in) :: path
    type(c_ptr) :: model
    model = c_read_mesh(trim(path) // c_null_char)
  end function

  logical function wellknit_write(model, path, format, overwrite)
    type(c_ptr), intent(in) :: model
    character(*), intent(in) :: path, format
    logical, intent(in) :: overwrite
    wellknit_write = c_write(model, trim(path) // c_null_char, trim(format) // c_null_char, &
                             merge(1_c_int, 0_c_int, overwrite)) == 0
  end function

  function wellknit_last_error() result(text)
    character(:), allocatable :: text
    character(kind=c_char), pointer :: bytes(:)
    type(c_ptr) :: start
    integer :: i
    start = c_last_error()
    call c_f_pointer(start, bytes, [c_strlen(start)])
    allocate(character(size(bytes)) :: text)
    do i = 1, size(bytes)
      text(i:i) = bytes(i)
    end do
  end function

  !> An array of reals, columns first; not associated where there is none of this name.
  function wellknit_reals(model, name) result(values)
    type(c_ptr), intent(in) :: model
    character(*), intent(in) :: name
    real(c_double), pointer :: values(:, :)
    type(view) :: found
    nullify(values)
    if (c_array(model, trim(name) // c_null_char, found) /= 0) return
    if (found%type == float64) call c_f_pointer(found%data, values, [found%columns, found%rows])
  end function

  !> An array of 32-bit integers, columns first; not associated where there is none of this name.
  function wellknit_integers(model, name) result(values)
    type(c_ptr), intent(in) :: model
    character(*), intent(in) :: name
    integer(c_int32_t), pointer :: values(:, :)
    type(view) :: found
    nullify(values)
    if (c_array(model, trim(name) // c_null_char, found) /= 0) return
    if (found%type == int32) call c_f_pointer(found%data, values, [found%columns, found%rows])
  end function

end module
