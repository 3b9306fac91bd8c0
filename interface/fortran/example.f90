! SPDX-FileCopyrightText: 2026 The wellknit authors
! SPDX-License-Identifier: GPL-3.0-or-later

!> example CASE TRAJECTORY OUT.h5: a mesh in memory, as a simulator takes it; prints cells, connections, the sum of the
!> volumes, and the largest transmissibility.
program example
  use, intrinsic :: iso_c_binding
  use wellknit
  implicit none
  type(c_ptr) :: request, model
  real(c_double), pointer :: volume(:, :), transmissibility(:, :)
  integer(c_int32_t), pointer :: cells(:, :)
  character(1000) :: arguments(3)
  integer :: i

  do i = 1, 3
    call get_command_argument(i, arguments(i))
  end do
  request = wellknit_open_case(arguments(1))
  if (.not. c_associated(request)) call fail()
  if (.not. wellknit_add_trajectory(request, arguments(2))) call fail()
  model = wellknit_build(request)
  if (.not. c_associated(model)) call fail()
  volume => wellknit_reals(model, "cells/volume")
  cells => wellknit_integers(model, "connections/cells")
  transmissibility => wellknit_reals(model, "connections/transmissibility")
  if (.not. wellknit_write(model, arguments(3), "hdf5", .true.)) call fail()
  print "(i0, 1x, i0, 1x, es22.15, 1x, es22.15)", size(volume, 2), size(cells, 2), sum(volume), &
    maxval(transmissibility)
  call wellknit_free_model(model)
  call wellknit_free_request(request)

contains

  subroutine fail()
    print "(a)", wellknit_last_error()
    error stop 1
  end subroutine

end program
