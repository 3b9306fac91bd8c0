/* SPDX-FileCopyrightText: 2026 The wellknit authors
 * SPDX-License-Identifier: GPL-3.0-or-later
 *
 * c_interface_test GRID TRAJECTORY OUT.h5: what a C program does with wellknit.h, and what it does wrong.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "wellknit.h"

static int failures = 0;

#define EXPECT(condition)                                                                            \
  do {                                                                                               \
    if (!(condition)) {                                                                              \
      ++failures;                                                                                    \
      fprintf(stderr, "line %d: %s is not so; last error: %s\n", __LINE__, #condition, wellknit_last_error()); \
    }                                                                                                \
  } while (0)

#define REQUIRE(condition)      \
  do {                          \
    EXPECT(condition);          \
    if (!(condition)) exit(1);  \
  } while (0)

static int error_has(const char* word) { return strstr(wellknit_last_error(), word) != NULL; }

static double sum_of(const wellknit_view* view) {
  const double* values = view->data;
  double sum = 0.0;
  for (int64_t i = 0; i < view->rows * view->columns; ++i) sum += values[i];
  return sum;
}

static void reads_what_it_wrote(const wellknit_model* model, const char* path) {
  wellknit_view before, after;
  const char* name;
  wellknit_model* again;
  int64_t arrays = 0;
  REQUIRE(wellknit_write(model, path, NULL, 1) == WELLKNIT_OK);
  EXPECT(wellknit_write(model, path, "hdf5", 0) == WELLKNIT_FAILED && error_has("--overwrite"));
  again = wellknit_read_mesh(path);
  REQUIRE(again != NULL);
  while ((name = wellknit_array_name(model, arrays)) != NULL) {
    static const int64_t sizes[] = {8, 8, 4, 1};
    REQUIRE(wellknit_array(model, name, &before) == WELLKNIT_OK);
    REQUIRE(wellknit_array(again, name, &after) == WELLKNIT_OK);
    EXPECT(before.rows == after.rows && before.columns == after.columns && before.type == after.type);
    EXPECT(before.rows == 0 || memcmp(before.data, after.data, (size_t)(before.rows * before.columns * sizes[before.type])) == 0);
    ++arrays;
  }
  EXPECT(arrays > 35);
  EXPECT(wellknit_well_reason(again, 0) == NULL); /* not in the file */
  wellknit_free_model(again);
}

static void builds(const char* grid, const char* trajectory, const char* out) {
  const double xyz[] = {250.0, 260.0, 1900.0, 255.0, 262.0, 2600.0};
  wellknit_well_options options = wellknit_well_defaults();
  wellknit_request* request = wellknit_open_case(grid);
  wellknit_model* model;
  wellknit_view volume, cells, transmissibility;
  const char* text = NULL;
  REQUIRE(request != NULL);
  EXPECT(options.drainage_radius == 15.0 && options.bore_radius == 0.1 && options.sectors == 10 && options.rings == 5);
  options.sectors = 8;
  EXPECT(wellknit_add_trajectory(request, trajectory, &options) == WELLKNIT_OK);
  EXPECT(wellknit_add_trajectory(request, trajectory, NULL) == WELLKNIT_FAILED && error_has("two wells are named"));
  EXPECT(wellknit_add_path(request, "straight", 2, xyz, NULL, NULL) == WELLKNIT_OK);
  EXPECT(wellknit_set(request, "threads", "1") == WELLKNIT_OK);
  model = wellknit_build(request);
  REQUIRE(model != NULL);
  wellknit_free_request(request);

  EXPECT(wellknit_well_count(model) == 2);
  EXPECT(strcmp(wellknit_well_name(model, 1), "straight") == 0);
  EXPECT(wellknit_well_name(model, 2) == NULL);
  EXPECT(strcmp(wellknit_well_reason(model, 0), "") == 0);
  EXPECT(wellknit_array(model, "cells/colour", &volume) == WELLKNIT_FAILED && error_has("the mesh has no array cells/colour"));
  REQUIRE(wellknit_array(model, "cells/volume", &volume) == WELLKNIT_OK);
  EXPECT(volume.type == WELLKNIT_FLOAT64 && volume.columns == 1 && sum_of(&volume) > 0.0);
  REQUIRE(wellknit_array(model, "connections/cells", &cells) == WELLKNIT_OK);
  REQUIRE(wellknit_array(model, "connections/transmissibility", &transmissibility) == WELLKNIT_OK);
  EXPECT(cells.type == WELLKNIT_INT32 && cells.columns == 2 && cells.rows == transmissibility.rows);
  for (int64_t i = 0; i < 2 * cells.rows; ++i)
    if (((const int32_t*)cells.data)[i] < 0 || ((const int32_t*)cells.data)[i] >= volume.rows) ++failures;
  EXPECT(wellknit_check(model, &text) == 0 && strcmp(text, "") == 0);
  EXPECT(wellknit_quality(model) != NULL && strstr(wellknit_quality(model), "\"nonorth_made_max_deg\"") != NULL);
  reads_what_it_wrote(model, out);
  wellknit_free_model(model);
}

static void refuses(const char* grid) {
  const double level[] = {0.0, 0.0, 1.0, 0.0, 0.0, 1.0};
  const double nowhere[] = {0.0, 0.0, NAN, 0.0, 0.0, 1.0};
  wellknit_well_options options = wellknit_well_defaults();
  wellknit_request* request;
  wellknit_view view;
  EXPECT(wellknit_open_case("no such file") == NULL && error_has("no such file"));
  EXPECT(wellknit_open_case(NULL) == NULL && error_has("null"));
  EXPECT(wellknit_read_mesh(grid) == NULL && error_has(grid));
  EXPECT(wellknit_build(NULL) == NULL && error_has("null"));
  EXPECT(wellknit_array(NULL, "cells/volume", &view) == WELLKNIT_FAILED);
  request = wellknit_open_case(grid);
  REQUIRE(request != NULL);
  EXPECT(strcmp(wellknit_last_error(), "") == 0);
  EXPECT(wellknit_set(request, "refine", "often") == WELLKNIT_FAILED && error_has("refine"));
  EXPECT(wellknit_set(request, "colour", "red") == WELLKNIT_FAILED && error_has("colour"));
  EXPECT(wellknit_add_deck_wells(request, "all", NULL) == WELLKNIT_FAILED && error_has("no wells"));
  EXPECT(wellknit_add_path(request, "A", 2, level, NULL, NULL) == WELLKNIT_FAILED && error_has("measured depth"));
  EXPECT(wellknit_add_path(request, "A", 2, nowhere, NULL, NULL) == WELLKNIT_FAILED && error_has("not a number"));
  EXPECT(wellknit_add_path(request, "A", -1, level, NULL, NULL) == WELLKNIT_FAILED);
  EXPECT(wellknit_add_path(request, "", 2, level, NULL, NULL) == WELLKNIT_FAILED && error_has("name"));
  options.sectors = 2;
  EXPECT(wellknit_add_path(request, "A", 2, level + 3, NULL, &options) == WELLKNIT_FAILED);
  options = wellknit_well_defaults();
  options.mode = 7;
  EXPECT(wellknit_add_trajectory(request, "x", &options) == WELLKNIT_FAILED && error_has("mode"));
  wellknit_free_request(request);
  wellknit_free_request(NULL);
  wellknit_free_model(NULL);
}

int main(int count, char** arguments) {
  if (count != 4) return 2;
  EXPECT(strlen(wellknit_version()) >= 5);
  refuses(arguments[1]);
  builds(arguments[1], arguments[2], arguments[3]);
  return failures == 0 ? 0 : 1;
}
