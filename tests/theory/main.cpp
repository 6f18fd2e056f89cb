// Writes docs/theory.md and, given a folder of models, docs/contexts.md: theory FOLDER [MODELS]

#include <cstdio>
#include <fstream>

#include "tests/theory/experiments.h"

namespace {

bool write(const std::filesystem::path& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  file.close();
  std::fprintf(stderr, "theory: %s %s\n", file ? "wrote" : "cannot write", path.c_str());
  return bool(file);
}

std::string theory() {
  std::string text =
      "# Theory, measured\n\n"
      "`./dev theory` writes this file: connectivity sections, every one decoded and compared. The columns `paper`,\n"
      "`fast`, `default` and `small` are the coder's profiles. `tests/codec/theory_test.cpp` holds the same against\n"
      "bounds, on smaller meshes; `tests/shapes` makes them all by rule.\n";
  using namespace tutte::theory;
  for (const auto chapter :
       {regularMeshes, duals, uniformTriangulations, uniformPolyhedra, semiRegularMeshes, adaptiveTessellations}) {
    text += "\n" + chapter();
    std::fprintf(stderr, ".");
  }
  std::fprintf(stderr, "\n");
  return text;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2 || argc > 3) return std::fprintf(stderr, "Usage: theory FOLDER [MODELS]\n"), 1;
  const std::filesystem::path folder = argv[1];
  std::filesystem::create_directories(folder);
  if (!write(folder / "theory.md", theory())) return 5;
  if (argc == 2) return 0;
  const std::string text =
      "# What contexts are worth, by size\n\n"
      "`./dev theory` writes this file where the models are: in `../shared/corpus`, or the folder that `TUTTE_CORPUS`\n"
      "names.\n\n" +
      tutte::theory::gainOfContexts(argv[2]);
  return write(folder / "contexts.md", text) ? 0 : 5;
}
