/* SPDX-FileCopyrightText: 2026 The wellknit authors
 * SPDX-License-Identifier: GPL-3.0-or-later
 *
 * wellknit for C, and for every language that calls C: a case and wells to a mesh in memory.
 *
 *   wellknit_request* request = wellknit_open_case("FIELD.DATA");
 *   if (request == NULL || wellknit_add_trajectory(request, "P1.csv", NULL) != WELLKNIT_OK) …wellknit_last_error()…
 *   wellknit_model* model = wellknit_build(request);
 *   wellknit_view volume;
 *   wellknit_array(model, "cells/volume", &volume);        …volume.rows numbers at (const double*)volume.data…
 *   wellknit_free_model(model);
 *   wellknit_free_request(request);
 *
 * Lengths are metres, depths positive down, everything else SI. Arrays have the names, shapes and units of the mesh
 * file (docs/formats/hdf5.md), rows first, indices from 0; only integers that name cells, faces, vertices or wells have
 * 32 bits here, -1 for none. A function that fails returns NULL or WELLKNIT_FAILED, and says why in
 * wellknit_last_error(). Nothing is printed. One model may be read by several threads; everything that reads or writes
 * files, one at a time.
 */
#ifndef WELLKNIT_H
#define WELLKNIT_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { WELLKNIT_OK = 0, WELLKNIT_FAILED = 1 };

/* Element types of a view. */
enum { WELLKNIT_FLOAT64 = 0, WELLKNIT_INT64 = 1, WELLKNIT_INT32 = 2, WELLKNIT_UINT8 = 3 };

typedef struct wellknit_request wellknit_request;
typedef struct wellknit_model wellknit_model;

/* The radial mesh of a well. Take wellknit_well_defaults() and change what you need. */
typedef struct {
  double drainage_radius; /* m, of the outermost ring */
  double bore_radius;     /* m */
  double skin;
  double growth;    /* ratio of successive ring widths; 0: radii in geometric progression */
  int32_t sectors;  /* 3 or more */
  int32_t rings;    /* 1 or more */
  int32_t segments; /* cells along a swept well; 0: chosen */
  int32_t mode;     /* 0 chosen, 1 layered, 2 swept */
} wellknit_well_options;

/* rows x columns numbers, row after row. Valid as long as the model. */
typedef struct {
  const void* data;
  int64_t rows;
  int64_t columns;
  int32_t type;
} wellknit_view;

/* "0.1.0" */
const char* wellknit_version(void);

/* One line on the last failure of this thread; "" where there was none. Valid until the next call of this thread. */
const char* wellknit_last_error(void);

wellknit_well_options wellknit_well_defaults(void);

/* A deck, GRDECL, EGRID or other grid. NULL: failed. */
wellknit_request* wellknit_open_case(const char* path);

/* The wells of a trajectory file of any kind that `wellknit build --well` reads. options NULL: the defaults. */
int wellknit_add_trajectory(wellknit_request* request, const char* path, const wellknit_well_options* options);

/* A well by its points: xyz has 3 numbers a point, x, y, depth. measured_depth NULL: the length along the points. */
int wellknit_add_path(wellknit_request* request, const char* name, int64_t points, const double* xyz,
                      const double* measured_depth, const wellknit_well_options* options);

/* Wells of the deck: "all", or names separated by commas. */
int wellknit_add_deck_wells(wellknit_request* request, const char* names, const wellknit_well_options* options);

/* mapping, refine, fault-policy, heal-throw, fluxes or threads, with the values of `wellknit build --NAME`. */
int wellknit_set(wellknit_request* request, const char* option, const char* value);

/* NULL: failed. A well that cannot be meshed is no failure: wellknit_well_reason(). */
wellknit_model* wellknit_build(const wellknit_request* request);

/* A mesh file. NULL: failed. */
wellknit_model* wellknit_read_mesh(const char* path);

/* format as in `wellknit formats`; NULL: by the path's extension. The file appears whole or not at all. */
int wellknit_write(const wellknit_model* model, const char* path, const char* format, int overwrite);

/* An array of the model by its name in the mesh file, such as "connections/transmissibility". */
int wellknit_array(const wellknit_model* model, const char* name, wellknit_view* view);

/* Names of all arrays, from 0 on; NULL after the last. */
const char* wellknit_array_name(const wellknit_model* model, int64_t index);

int64_t wellknit_well_count(const wellknit_model* model);
/* NULL where there is no such well. */
const char* wellknit_well_name(const wellknit_model* model, int64_t well);
/* Why a well of a build has no radial mesh, and what would help; "" where it has one, NULL where it is not known. */
const char* wellknit_well_reason(const wellknit_model* model, int64_t well);

/* Violations of what a valid mesh has, and one line for each, ended by '\n', in text (may be NULL), which lives as long
 * as the model. -1: failed. */
int64_t wellknit_check(const wellknit_model* model, const char** text);

/* Figures of `wellknit check --json` as JSON text; lives as long as the model. NULL: failed. */
const char* wellknit_quality(const wellknit_model* model);

/* NULL is allowed. */
void wellknit_free_request(wellknit_request* request);
void wellknit_free_model(wellknit_model* model);

#ifdef __cplusplus
}
#endif

#endif
