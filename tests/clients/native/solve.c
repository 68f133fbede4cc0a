/* Solves requests and sweeps with a library that is loaded by its path, on Linux and Windows.
 *   solve LIBRARY FOLDER FILE...   writes the document of each file to FOLDER, and "NAME STATUS SECONDS" for each to standard output
 * A file whose name begins with sweep is a sweep. An analysis whose name begins with cancelled is stopped at its fifth step. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "clients/c/snapthrough.h"

#ifdef _WIN32
#include <windows.h>
static void* load(const char* path) { return (void*)LoadLibraryA(path); }
static void* symbol(void* library, const char* name) { return (void*)GetProcAddress((HMODULE)library, name); }
#else
#include <dlfcn.h>
static void* load(const char* path) { return dlopen(path, RTLD_NOW); }
static void* symbol(void* library, const char* name) { return dlsym(library, name); }
#endif

typedef snapthrough_document* (*solve_function)(const char*, size_t, const snapthrough_options*, snapthrough_callback, void*);
typedef snapthrough_document* (*sweep_function)(const char*, size_t, uint64_t, uint64_t, const snapthrough_options*,
                                                snapthrough_callback, void*);
typedef void (*free_function)(snapthrough_document*);

static int stop_at_fifth(const snapthrough_progress* progress, void* steps) {
  (void)progress;
  return ++*(int*)steps >= 5;
}

static char* read_file(const char* path, size_t* length) {
  FILE* file = fopen(path, "rb");
  if (file == NULL) {
    return NULL;
  }
  fseek(file, 0, SEEK_END);
  *length = (size_t)ftell(file);
  rewind(file);
  char* text = malloc(*length + 1);
  const size_t got = text == NULL ? 0 : fread(text, 1, *length, file);
  fclose(file);
  return got == *length ? text : NULL;
}

static const char* name_of(const char* path) {
  const char* name = path;
  for (const char* c = path; *c != 0; ++c) {
    name = *c == '/' || *c == '\\' ? c + 1 : name;
  }
  return name;
}

int main(int argc, char** argv) {
  void* library = argc > 3 ? load(argv[1]) : NULL;
  if (library == NULL) {
    fprintf(stderr, "usage: solve LIBRARY FOLDER FILE..., with a library that can be loaded\n");
    return 1;
  }
  const solve_function solve = (solve_function)symbol(library, "snapthrough_solve");
  const sweep_function sweep = (sweep_function)symbol(library, "snapthrough_sweep");
  const free_function release = (free_function)symbol(library, "snapthrough_free");
  for (int i = 3; i < argc; ++i) {
    const char* name = name_of(argv[i]);
    size_t length = 0;
    char* text = read_file(argv[i], &length);
    if (text == NULL) {
      fprintf(stderr, "cannot read %s\n", argv[i]);
      return 1;
    }
    int steps = 0;
    const clock_t begin = clock();
    snapthrough_document* answer =
        strncmp(name, "sweep", 5) == 0
            ? sweep(text, length, 0, UINT64_MAX, NULL, NULL, NULL)
            : solve(text, length, NULL, strncmp(name, "cancelled", 9) == 0 ? stop_at_fifth : NULL, &steps);
    const double seconds = (double)(clock() - begin) / CLOCKS_PER_SEC;
    char path[4096];
    snprintf(path, sizeof path, "%s/%s", argv[2], name);
    FILE* out = fopen(path, "wb");
    if (answer == NULL || out == NULL || fwrite(answer->text, 1, answer->length, out) != answer->length || fclose(out) != 0) {
      fprintf(stderr, "no document of %s\n", name);
      return 1;
    }
    printf("%s %d %.6f\n", name, (int)answer->status, seconds);
    release(answer);
    free(text);
  }
  return 0;
}
