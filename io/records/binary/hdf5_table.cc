#include "io/records/binary/hdf5_table.h"

// The form of H5O_info_t that 1.10 and later have in common.
#define H5O_info_t_vers 1
#include <hdf5.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "io/records/binary/array_columns.h"
#include "io/records/binary/hdf5_lock.h"
#include "io/records/binary/survival.h"
#include "io/records/columns/packed_size.h"
#include "io/user_error.h"

namespace howl {
namespace {

std::mutex& Hdf5Mutex() {
  static std::mutex mutex;
  return mutex;
}

class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  hid_t get() const { return id_; }
  bool ok() const { return id_ >= 0; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

std::string Problem(hid_t dataset, int rank) {
  const Handle type(H5Dget_type(dataset), H5Tclose);
  switch (H5Tget_class(type.get())) {
    case H5T_INTEGER:
    case H5T_FLOAT:
      break;
    case H5T_STRING:
      return "text";
    case H5T_COMPOUND:
      return "complex or compound";
    default:
      return "not numeric";
  }
  return rank == 1 || rank == 2 ? "" : std::to_string(rank) + " dimensions";
}

// A chunk is unpacked as a whole; 0 without any.
double ChunkBytes(hid_t dataset) {
  const Handle plist(H5Dget_create_plist(dataset), H5Pclose);
  if (!plist.ok() || H5Pget_layout(plist.get()) != H5D_CHUNKED) return 0.0;
  std::array<hsize_t, H5S_MAX_RANK> sizes{};
  const int rank = H5Pget_chunk(plist.get(), H5S_MAX_RANK, sizes.data());
  const Handle type(H5Dget_type(dataset), H5Tclose);
  auto bytes = static_cast<double>(H5Tget_size(type.get()));
  for (int i = 0; i < rank; ++i) bytes *= static_cast<double>(sizes[static_cast<std::size_t>(i)]);
  return bytes;
}

herr_t AddDataset(hid_t root, const char* name, const H5O_info_t* info, void* arrays) {
  if (info->type != H5O_TYPE_DATASET) return 0;
  const Handle dataset(H5Dopen2(root, name, H5P_DEFAULT), H5Dclose);
  const Handle space(H5Dget_space(dataset.get()), H5Sclose);
  if (!dataset.ok() || !space.ok()) return 0;
  const int rank = H5Sget_simple_extent_ndims(space.get());
  ArrayInfo array{name, 0, 0, Problem(dataset.get(), rank)};
  if (rank == 1 || rank == 2) {
    std::array<hsize_t, 2> sizes = {0, 1};
    H5Sget_simple_extent_dims(space.get(), sizes.data(), nullptr);
    array.rows = sizes[0];
    array.columns = sizes[1];
  }
  static_cast<std::vector<ArrayInfo>*>(arrays)->push_back(std::move(array));
  return 0;
}

class Hdf5Table final : public TableSource {
 public:
  Hdf5Table(const std::filesystem::path& file, Hdf5Names names)
      : file_(file.string()),
        names_(names),
        root_(H5Fopen(file_.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose) {
    if (!root_.ok()) throw UserError(file_, 0, "", "truncated or damaged, expected an HDF5 file");
    H5Ovisit2(root_.get(), H5_INDEX_NAME, H5_ITER_INC, AddDataset, &arrays_, H5O_INFO_BASIC);
    if (names_ == Hdf5Names::kPaths) return;
    std::erase_if(arrays_, [](const ArrayInfo& array) { return array.name.starts_with('#'); });
    for (ArrayInfo& array : arrays_) std::ranges::replace(array.name, '/', '.');
  }

  Columns Read(const std::vector<ColumnName>& names) override {
    const Hdf5Lock lock;
    RequireSurvival(file_, [&] { ReadColumns(names); });
    return ReadColumns(names);
  }

  std::vector<ColumnInfo> List() const override { return ListChannels(arrays_); }
  std::string Format() const override {
    return names_ == Hdf5Names::kMatlab ? "a MATLAB 7.3 file" : "an HDF5 file";
  }

 private:
  std::string PathOf(const ArrayInfo& array) const {
    std::string path = array.name;
    if (names_ == Hdf5Names::kMatlab) std::ranges::replace(path, '.', '/');
    return path;
  }

  Columns ReadColumns(const std::vector<ColumnName>& names) const {
    Columns columns;
    for (const ArrayChannel& channel : FindChannels(file_, arrays_, names)) {
      columns.push_back(ReadChannel(arrays_[channel.array], channel.channel));
    }
    return columns;
  }

  std::vector<double> ReadChannel(const ArrayInfo& array, std::size_t channel) const {
    std::vector<double> column(array.samples());
    if (column.empty()) return column;
    const Handle dataset(H5Dopen2(root_.get(), PathOf(array).c_str(), H5P_DEFAULT), H5Dclose);
    const Handle space(H5Dget_space(dataset.get()), H5Sclose);
    if (IsBomb(static_cast<double>(std::filesystem::file_size(file_)), ChunkBytes(dataset.get()))) {
      throw UserError(file_, 0, array.name, kBombWords);
    }
    if (array.channels() > 1) {
      std::array<hsize_t, 2> start = {0, channel};
      std::array<hsize_t, 2> count = {array.rows, 1};
      if (!array.along_rows()) {
        std::swap(start[0], start[1]);
        count = {1, array.columns};
      }
      H5Sselect_hyperslab(space.get(), H5S_SELECT_SET, start.data(), nullptr, count.data(),
                          nullptr);
    }
    const hsize_t length = column.size();
    const Handle memory(H5Screate_simple(1, &length, nullptr), H5Sclose);
    if (!dataset.ok() || !memory.ok() ||
        H5Dread(dataset.get(), H5T_NATIVE_DOUBLE, memory.get(), space.get(), H5P_DEFAULT,
                column.data()) < 0) {
      throw UserError(file_, 0, array.name,
                      "cannot be read: truncated, damaged or packed in a way not known here");
    }
    return column;
  }

  std::string file_;
  Hdf5Names names_;
  Handle root_;
  std::vector<ArrayInfo> arrays_;
};

// Closes the file under the lock, too.
class LockedHdf5Table final : public TableSource {
 public:
  LockedHdf5Table(const std::filesystem::path& file, Hdf5Names names)
      : table_(std::make_unique<Hdf5Table>(file, names)) {}
  ~LockedHdf5Table() override {
    const Hdf5Lock lock;
    table_.reset();
  }
  Columns Read(const std::vector<ColumnName>& names) override { return table_->Read(names); }
  std::vector<ColumnInfo> List() const override { return table_->List(); }
  std::string Format() const override { return table_->Format(); }

 private:
  std::unique_ptr<Hdf5Table> table_;
};

}  // namespace

Hdf5Lock::Hdf5Lock() : lock_(Hdf5Mutex()) { H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); }

std::unique_ptr<TableSource> OpenHdf5Table(const std::filesystem::path& file, Hdf5Names names) {
  const Hdf5Lock lock;
  RequireSurvival(file.string(), [&] { const Hdf5Table table(file, names); });
  return std::make_unique<LockedHdf5Table>(file, names);
}

}  // namespace howl
