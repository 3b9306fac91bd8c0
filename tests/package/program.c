/* SPDX-FileCopyrightText: 2026 The wellknit authors
 * SPDX-License-Identifier: GPL-3.0-or-later
 *
 * program GRID OUT.h5: a stranger's C program, built with what pkg-config says. */
#include <stdio.h>
#include <wellknit.h>

int main(int count, char** arguments) {
  wellknit_request* request = count == 3 ? wellknit_open_case(arguments[1]) : NULL;
  wellknit_model* model = request == NULL ? NULL : wellknit_build(request);
  wellknit_view volume;
  if (model == NULL || wellknit_array(model, "cells/volume", &volume) != WELLKNIT_OK ||
      wellknit_write(model, arguments[2], "hdf5", 1) != WELLKNIT_OK) {
    fprintf(stderr, "%s\n", wellknit_last_error());
    return 1;
  }
  printf("wellknit %s: %lld cells\n", wellknit_version(), (long long)volume.rows);
  wellknit_free_model(model);
  wellknit_free_request(request);
  return 0;
}
