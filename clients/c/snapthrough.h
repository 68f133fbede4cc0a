/**
 * @file
 * C interface of snapthrough: equilibrium paths and critical loads of slender structures on elastic bases.
 *
 * Documents are JSON in UTF-8, the same as those of the command line and of the HTTP service: docs/requests.md,
 * docs/sweeps.md and docs/results.md of the project describe them; its OpenAPI document lists every field.
 *
 * Every function can be called from several threads at once. Calls share nothing except a snapthrough_stop in the
 * options of several calls. Equal requests give equal bytes, except for "diagnostics.wall_time_s". No function
 * throws, writes to a standard stream, changes a locale or a signal handler, or ends the process.
 */
#ifndef SNAPTHROUGH_SNAPTHROUGH_H
#define SNAPTHROUGH_SNAPTHROUGH_H

#include <stddef.h>
#include <stdint.h>

#if defined(__GNUC__)
#define SNAPTHROUGH_EXPORT __attribute__((visibility("default")))
#else
#define SNAPTHROUGH_EXPORT
#endif

#ifdef __cplusplus
extern "C" {
#endif

/** Outcome of a call. The values 0, 2 and 3 are the exit statuses of the command line. */
typedef enum snapthrough_status {
  SNAPTHROUGH_DONE = 0,          /**< success: the document is the requested one */
  SNAPTHROUGH_WRONG_USE = 1,     /**< an argument of the call is invalid; the document has the rule */
  SNAPTHROUGH_WRONG_REQUEST = 2, /**< the request has mistakes; the document lists them */
  SNAPTHROUGH_NOT_COMPLETED = 3, /**< the analysis failed; the document has "failure" and the part before it */
  SNAPTHROUGH_CANCELLED = 4,     /**< the caller stopped the call; the document has the part before that */
  SNAPTHROUGH_OUT_OF_MEMORY = 5, /**< the document is a problem with the code "out_of_memory" */
  SNAPTHROUGH_INTERNAL_ERROR = 6 /**< a defect of the library; the document is a problem with its message */
} snapthrough_status;

/**
 * A document that a call returned. A null pointer means SNAPTHROUGH_OUT_OF_MEMORY: not even the few bytes of a
 * problem could be allocated. The caller owns the document and releases it with snapthrough_free().
 *
 * With the statuses WRONG_USE, WRONG_REQUEST, OUT_OF_MEMORY and INTERNAL_ERROR, the text is a problem like those of
 * the HTTP service (RFC 9457): {"type", "title", "status", "detail"}, with "errors": [{"pointer", "code", "detail"}]
 * for a wrong request, and with "code" for a failed analysis.
 */
typedef struct snapthrough_document {
  const char* text;          /**< UTF-8 JSON, followed by a zero byte */
  size_t length;             /**< bytes of the text without the zero byte */
  snapthrough_status status; /**< outcome of the call */
} snapthrough_document;

/** Progress of a call. New versions append fields; `size` tells which ones the library has. */
typedef struct snapthrough_progress {
  size_t size;              /**< sizeof(snapthrough_progress) of the library */
  uint64_t done;            /**< sweeps: points that have ended; analyses: steps along the branch */
  uint64_t total;           /**< sweeps: points of this call; analyses: 0, since their number is not known */
  double load_factor;       /**< load factor of the last point of the path; sweeps: 0 */
  int branch;               /**< index of the path's branch, from 0; sweeps: 0 */
  int negative_eigenvalues; /**< negative eigenvalues of the tangent stiffness; 0: stable; sweeps: 0 */
  double arc_length;        /**< arc length of the path up to its last point; sweeps: 0 */
  const double* monitors;   /**< values of the monitors at that point, in the order of the model; until the callback returns */
  size_t monitor_count;     /**< number of these values; sweeps: 0 */
} snapthrough_progress;

/**
 * Called on the thread of the call, after each step of a path or each item of a sweep. A value other than 0 stops
 * the call, which then returns SNAPTHROUGH_CANCELLED. The callback may call any function of this library. It must
 * not throw and must not leave by longjmp.
 */
typedef int (*snapthrough_callback)(const snapthrough_progress* progress, void* user);

/** Stops running calls from another thread. */
typedef struct snapthrough_stop snapthrough_stop;

/** Options of a call. New versions append fields. A null pointer to options means the defaults. */
typedef struct snapthrough_options {
  size_t size;            /**< sizeof(snapthrough_options), which tells later versions the fields of the caller */
  snapthrough_stop* stop; /**< stops the call; null: only the callback can */
} snapthrough_options;

/** The version of the library, such as "0.1.0". The text belongs to the library. */
SNAPTHROUGH_EXPORT const char* snapthrough_version(void);

/** Returns a new object that can stop calls; null without memory. */
SNAPTHROUGH_EXPORT snapthrough_stop* snapthrough_stop_new(void);

/**
 * Stops every running and later call with `stop` in its options. A call returns within a few steps of its iteration,
 * normally within milliseconds. Can be called from any thread and repeated. Null is ignored.
 */
SNAPTHROUGH_EXPORT void snapthrough_stop_request(snapthrough_stop* stop);

/** Releases an object of snapthrough_stop_new(); calls with it may still run. Null is ignored. */
SNAPTHROUGH_EXPORT void snapthrough_stop_free(snapthrough_stop* stop);

/**
 * Solves one request.
 *
 * @param request  UTF-8 JSON: {"model": ..., "analysis": ...}; need not end with a zero byte
 * @param length   bytes of the request; the caller bounds it
 * @param options  null for the defaults
 * @param callback called after each step of a path; null for none
 * @param user     passed to the callback
 * @return the result document with DONE, NOT_COMPLETED or CANCELLED, otherwise a problem
 */
SNAPTHROUGH_EXPORT snapthrough_document* snapthrough_solve(const char* request, size_t length,
                                                           const snapthrough_options* options,
                                                           snapthrough_callback callback, void* user);

/**
 * Finds every mistake of a request or a sweep without solving it.
 *
 * @param document UTF-8 JSON: a request, or a sweep, which has "parameters"
 * @param length   bytes of the document
 * @return {"valid", "errors": [{"pointer", "code", "detail"}...], "size"}, as POST /v1/check of the HTTP service
 *         answers: with DONE `size` is {"points", "unknowns", "expected"}, where `points` is 1 for a request, `unknowns`
 *         the number of equations of the first point that can be read, and `expected` {"cpu_seconds", "low", "high",
 *         "model"}, the processor time of all points by a law fitted to measured times, or null when no point can be
 *         read; with WRONG_REQUEST `size` is null and `errors` is not empty. Otherwise a problem
 */
SNAPTHROUGH_EXPORT snapthrough_document* snapthrough_check(const char* document, size_t length);

/**
 * Solves `count` points of a sweep from the point `first` on, one after the other on the calling thread. A caller
 * with more cores distributes the points among threads, processes or machines; a row does not depend on which other
 * points are solved in the same call.
 *
 * An item of a sweep is what is computed as one: a point, or all points of a curve along which a critical point is
 * followed. The sweep's unit is the number of points of an item; a first call with `count` 0 returns it.
 *
 * @param document UTF-8 JSON: a sweep
 * @param length   bytes of the document
 * @param first    a multiple of the unit, less than the number of points of the sweep
 * @param count    a multiple of the unit; points past the end of the sweep are left out
 * @param options  null for the defaults
 * @param callback called after each item; null for none
 * @param user     passed to the callback
 * @return with DONE or CANCELLED the table that `snapthrough sweep` writes, of these points:
 *         {"total", "unit", "kind": "table", "program": {"name", "version", "build", "target"}, "request_sha256",
 *         "columns": [name...], "rows": [[value...]...], "points": [number...]}, where `total` is
 *         the number of points of the whole sweep, and `points` has the number of the point of each row, counted
 *         from 0. The last column, "error", is null, or {"code", "detail"} of a point that failed. CANCELLED has
 *         the rows of the items that had ended. Otherwise a problem
 */
SNAPTHROUGH_EXPORT snapthrough_document* snapthrough_sweep(const char* document, size_t length, uint64_t first,
                                                           uint64_t count, const snapthrough_options* options,
                                                           snapthrough_callback callback, void* user);

/**
 * Draws a result, or the table of a sweep, in the style of the web page's figures (docs/howto/plot-results.md).
 *
 * @param document       UTF-8 JSON: what snapthrough_solve() or snapthrough_sweep() returned, or a file of the
 *                       command line or the service
 * @param length         bytes of the document
 * @param choices        null, or UTF-8 JSON, an object with any of: "kind" ("path", "shape", "sections", "mode",
 *                       "model", "law", "laws", "frequencies", "stiffness", "sweep", "heatmap"), "width",
 *                       "height" (pixels), "dark", "state", "mode", "branch" (indices from 0), "monitor",
 *                       "over_arc_length", "magnify", "law" (id of a spring or foundation), "output" (JSON
 *                       Pointer), "x", "by" (names of parameters), "where" ({name: value}), "solved_request"
 *                       (the request, so that supports, ground, loads and laws can be drawn)
 * @param choices_length bytes of the choices
 * @return with DONE an SVG document (text that is no JSON); otherwise a problem, whose "errors" have pointers into
 *         the document, or into the choices if they begin with "choices:"
 */
SNAPTHROUGH_EXPORT snapthrough_document* snapthrough_plot(const char* document, size_t length, const char* choices,
                                                          size_t choices_length);

/** Releases a document. Null is ignored. */
SNAPTHROUGH_EXPORT void snapthrough_free(snapthrough_document* document);

#ifdef __cplusplus
}
#endif

#endif
