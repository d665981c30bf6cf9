// SPDX-License-Identifier: BSD-3-Clause
// Writes the corpus: las_corpus_maker FOLDER
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>

#include "io/columns.hpp"
#include "io/las/read.hpp"
#include "io/las/write.hpp"
#include "io/las_files.hpp"
#include "kappa/core/error.hpp"
#include "kappa/scan/scan.hpp"

namespace {

using kappa::test::LasSpec;

void save(const std::filesystem::path& file, const std::string& bytes) {
  std::ofstream out(file, std::ios::binary);
  out << bytes;
  if (!out) throw kappa::Error(kappa::ErrorCode::FileWrite, "'" + file.string() + "' cannot be written");
}

/// A file of LAS 1.4 that our writer makes of one of the matrix.
std::string rewritten(const std::string& bytes) {
  const kappa::io::FileBytes file{"corpus", bytes};
  kappa::Scan scan = kappa::io::read_las(file, {});
  kappa::io::finish(file.path, scan);
  scan.fields.push_back({"label", kappa::Field::Type::UInt8, std::vector<double>(scan.points.size(), 3)});
  std::ostringstream out;
  kappa::io::write_las(out, scan, {});
  return out.str();
}

/// A cloud that came from no LAS file.
std::string cloud() {
  kappa::Scan scan;
  scan.points = {{0, 0, 0}, {1.5, 0, 0.25}, {0, 2.125, 1}};
  scan.normals.assign(3, kappa::Vec3(0, 0, 1));
  for (const char* name : {"red", "green", "blue"})
    scan.fields.push_back({name, kappa::Field::Type::UInt16, {1, 2, 65535}});
  std::ostringstream out;
  kappa::io::write_las(out, scan, {});
  return out.str();
}

void make_corpus(const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  for (LasSpec spec : kappa::test::las_matrix()) {
    spec.points = 2;
    const std::string name = "1." + std::to_string(spec.minor) + "_" + std::to_string(spec.format);
    save(folder / (name + ".las"), las_file(spec));
    if (spec.minor == 4) save(folder / (name + "_written.las"), rewritten(las_file(spec)));
  }
  save(folder / "cloud.las", cloud());
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "las_corpus_maker FOLDER\n";
    return 2;
  }
  try {
    make_corpus(argv[1]);
    return 0;
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
