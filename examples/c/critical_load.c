/* Solves a request file and prints its result document.
 *
 *   cc critical_load.c $(pkg-config --cflags --libs snapthrough) -o critical_load
 *   ./critical_load ../buried_pipe.json
 *
 * Ctrl-C stops the analysis; what was reached is printed. The exit status is that of the call. */
#include <signal.h>
#include <snapthrough/snapthrough.h>
#include <stdio.h>
#include <stdlib.h>

static volatile sig_atomic_t interrupted = 0;

static void on_interrupt(int signal_number) {
  (void)signal_number;
  interrupted = 1;
}

/* Called after each step of the path: shows it, and stops the analysis after Ctrl-C. */
static int on_progress(const snapthrough_progress* progress, void* user) {
  FILE* terminal = user;
  fprintf(terminal, "\rstep %llu, load factor %g   ", (unsigned long long)progress->done, progress->load_factor);
  return interrupted;
}

static char* read_file(const char* path, size_t* length) {
  FILE* file = fopen(path, "rb");
  char* text = NULL;
  long size;
  if (file == NULL) {
    return NULL;
  }
  if (fseek(file, 0, SEEK_END) == 0 && (size = ftell(file)) >= 0 && fseek(file, 0, SEEK_SET) == 0) {
    text = malloc((size_t)size + 1);
    *length = text != NULL ? fread(text, 1, (size_t)size, file) : 0;
  }
  fclose(file);
  return text;
}

int main(int argc, char** argv) {
  size_t length = 0;
  char* request = argc == 2 ? read_file(argv[1], &length) : NULL;
  snapthrough_document* result;
  int status;
  if (request == NULL) {
    fprintf(stderr, "usage: critical_load REQUEST.json\n");
    return EXIT_FAILURE;
  }
  signal(SIGINT, on_interrupt);
  result = snapthrough_solve(request, length, NULL, on_progress, stderr);
  free(request);
  if (result == NULL) {
    fprintf(stderr, "out of memory\n");
    return SNAPTHROUGH_OUT_OF_MEMORY;
  }
  fputc('\n', stderr);
  puts(result->text);
  status = (int)result->status;
  snapthrough_free(result);
  return status;
}
