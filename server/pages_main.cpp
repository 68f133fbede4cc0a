/// @file
/// Program of the build that writes manual pages, shell completion and the documents with tables of fields.

#include <filesystem>
#include <fstream>
#include <iostream>

#include "server/cli/pages/description.h"
#include "server/resources/page.h"

namespace {

void write(const std::filesystem::path& path, const std::string& text) {
  std::filesystem::create_directories(path.parent_path());
  std::ofstream file(path, std::ios::binary);
  file << text << std::flush;
  if (!file) {
    throw std::runtime_error("cannot write " + path.string());
  }
}

}  // namespace

int main(int argc, char** argv) {
  using namespace snapthrough::server::cli;
  if (argc != 3) {
    std::cerr << "usage: snapthrough_pages FOLDER DATE\n"
                 "Writes man1/*.1, bash/snapthrough, zsh/_snapthrough, fish/snapthrough.fish and docs/*.md "
                 "into FOLDER.\n";
    return 1;
  }
  try {
    const std::filesystem::path folder = argv[1];
    const ProgramPage program = describe_program();
    for (const ManualPage& page : manual_pages(program, argv[2])) {
      write(folder / "man1" / page.file, page.text);
    }
    write(folder / "bash" / "snapthrough", bash_completion(program));
    write(folder / "zsh" / "_snapthrough", zsh_completion(program));
    write(folder / "fish" / "snapthrough.fish", fish_completion(program));
    for (const snapthrough::server::http::FieldsDocument& document :
         snapthrough::server::http::fields_documents()) {
      write(folder / document.path.substr(1), document.text);
    }
  } catch (const std::exception& error) {
    std::cerr << "snapthrough_pages: " << error.what() << '\n';
    return 1;
  }
  return 0;
}
