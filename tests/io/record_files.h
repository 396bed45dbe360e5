// A temporary folder and files in every format that the tests read back, each written by the
// format's own library.
#ifndef HOWL_TESTS_IO_RECORD_FILES_H_
#define HOWL_TESTS_IO_RECORD_FILES_H_

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hdf5.h>
#include <matio.h>
#include <unistd.h>
#include <zlib.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "io/records/records.h"
#include "io/user_error.h"

namespace howl {

class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "howl_records.XXXXXX").string();
    path_ = mkdtemp(name.data());
  }
  ~TemporaryFolder() { std::filesystem::remove_all(path_); }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

  std::filesystem::path Write(const std::string& name, const std::string& bytes) const {
    std::ofstream(path_ / name, std::ios::binary) << bytes;
    return path_ / name;
  }

 private:
  std::filesystem::path path_;
};

inline std::string ReadBytes(const std::filesystem::path& path) {
  std::string bytes(std::filesystem::file_size(path), '\0');
  std::ifstream(path, std::ios::binary)
      .read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  return bytes;
}

inline std::filesystem::path WriteGzip(const std::filesystem::path& path, const std::string& text,
                                       const char* mode = "wb") {
  const gzFile file = gzopen(path.c_str(), mode);
  gzwrite(file, text.data(), static_cast<unsigned>(text.size()));
  gzclose(file);
  return path;
}

// Column after column, as MATLAB keeps them.
inline void AddMatVariable(mat_t* mat, const char* name, std::size_t rows, std::size_t columns,
                           std::vector<double> values,
                           matio_compression packing = MAT_COMPRESSION_NONE) {
  std::size_t sizes[2] = {rows, columns};
  matvar_t* variable = Mat_VarCreate(name, MAT_C_DOUBLE, MAT_T_DOUBLE, 2, sizes, values.data(), 0);
  ASSERT_EQ(Mat_VarWrite(mat, variable, packing), 0);
  Mat_VarFree(variable);
}

// Row after row, as C keeps them.
inline void AddDataset(hid_t file, const char* path, std::vector<hsize_t> sizes,
                       const std::vector<double>& values) {
  const hid_t space = H5Screate_simple(static_cast<int>(sizes.size()), sizes.data(), nullptr);
  const hid_t links = H5Pcreate(H5P_LINK_CREATE);
  H5Pset_create_intermediate_group(links, 1);
  const hid_t data = H5Dcreate2(file, path, H5T_IEEE_F64LE, space, links, H5P_DEFAULT, H5P_DEFAULT);
  ASSERT_GE(H5Dwrite(data, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), 0);
  H5Dclose(data);
  H5Pclose(links);
  H5Sclose(space);
}

// The one line that a user sees, the folder's name taken off.
inline std::string ErrorOf(const RecordSpec& spec) {
  try {
    LoadRecord(spec, "rig.yaml", 7);
  } catch (const UserError& error) {
    std::string text = error.what();
    const std::string folder = spec.file.parent_path().string() + "/";
    for (std::size_t at = text.find(folder); at != std::string::npos; at = text.find(folder)) {
      text.erase(at, folder.size());
    }
    return text;
  }
  return "no error";
}

}  // namespace howl

#endif  // HOWL_TESTS_IO_RECORD_FILES_H_
