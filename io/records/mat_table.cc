#include "io/records/mat_table.h"

#include <matio.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "io/records/array_columns.h"
#include "io/records/hdf5_lock.h"
#include "io/user_error.h"

namespace howl {
namespace {

struct CloseMat {
  void operator()(mat_t* mat) const { Mat_Close(mat); }
};
struct FreeVariable {
  void operator()(matvar_t* variable) const { Mat_VarFree(variable); }
};
using MatFile = std::unique_ptr<mat_t, CloseMat>;
using Variable = std::unique_ptr<matvar_t, FreeVariable>;

std::string Problem(const matvar_t& variable) {
  switch (variable.class_type) {
    case MAT_C_DOUBLE:
    case MAT_C_SINGLE:
    case MAT_C_INT8:
    case MAT_C_UINT8:
    case MAT_C_INT16:
    case MAT_C_UINT16:
    case MAT_C_INT32:
    case MAT_C_UINT32:
    case MAT_C_INT64:
    case MAT_C_UINT64:
      break;
    case MAT_C_CHAR:
      return "text";
    case MAT_C_STRUCT:
      return "a struct";
    case MAT_C_CELL:
      return "a cell array";
    case MAT_C_SPARSE:
      return "a sparse matrix";
    default:
      return "not numeric";
  }
  if (variable.isComplex != 0) return "complex";
  return variable.rank == 2 ? "" : std::to_string(variable.rank) + " dimensions";
}

class MatTable final : public TableSource {
 public:
  explicit MatTable(const std::filesystem::path& file)
      : file_(file.string()), mat_(Mat_Open(file_.c_str(), MAT_ACC_RDONLY)) {
    if (!mat_) throw UserError(file_, 0, "", "not a readable MATLAB .mat file");
    for (;;) {
      const Variable variable(Mat_VarReadNextInfo(mat_.get()));
      if (!variable) break;
      ArrayInfo array{variable->name != nullptr ? variable->name : "", 0, 0, Problem(*variable)};
      if (variable->rank == 2) {
        array.rows = variable->dims[0];
        array.columns = variable->dims[1];
      }
      arrays_.push_back(array);
    }
    std::sort(arrays_.begin(), arrays_.end(),
              [](const ArrayInfo& a, const ArrayInfo& b) { return a.name < b.name; });
  }

  ~MatTable() override {
    const Hdf5Lock lock;
    mat_.reset();
  }

  Columns Read(const std::vector<ColumnName>& names) override {
    const Hdf5Lock lock;
    Columns columns;
    for (const ArrayChannel& channel : FindChannels(file_, arrays_, names)) {
      columns.push_back(ReadChannel(arrays_[channel.array], channel.channel));
    }
    return columns;
  }

 private:
  template <typename T>
  void Convert(matvar_t* variable, int start, int stride, const std::string& name,
               std::vector<double>& column) {
    std::vector<T> raw(column.size());
    ReadInto(variable, raw.data(), start, stride, static_cast<int>(raw.size()), name);
    for (std::size_t i = 0; i < raw.size(); ++i) column[i] = static_cast<double>(raw[i]);
  }

  void ReadInto(matvar_t* variable, void* to, int start, int stride, int count,
                const std::string& name) {
    if (Mat_VarReadDataLinear(mat_.get(), variable, to, start, stride, count) != 0) {
      throw UserError(file_, 0, name, "cannot be read: the file is truncated or damaged");
    }
  }

  std::vector<double> ReadChannel(const ArrayInfo& array, std::size_t channel) {
    const Variable variable(Mat_VarReadInfo(mat_.get(), array.name.c_str()));
    if (!variable || array.rows * array.columns > std::numeric_limits<int>::max()) {
      throw UserError(file_, 0, array.name, "cannot be read: damaged, or 2^31 numbers or more");
    }
    std::vector<double> column(array.samples());
    if (column.empty()) return column;
    const int start = static_cast<int>(array.along_rows() ? channel * array.rows : channel);
    const int stride = array.along_rows() ? 1 : static_cast<int>(array.rows);
    const int count = static_cast<int>(column.size());
    matvar_t* v = variable.get();
    switch (v->class_type) {
      case MAT_C_DOUBLE:
        ReadInto(v, column.data(), start, stride, count, array.name);
        break;
      case MAT_C_SINGLE:
        Convert<float>(v, start, stride, array.name, column);
        break;
      case MAT_C_INT8:
        Convert<std::int8_t>(v, start, stride, array.name, column);
        break;
      case MAT_C_UINT8:
        Convert<std::uint8_t>(v, start, stride, array.name, column);
        break;
      case MAT_C_INT16:
        Convert<std::int16_t>(v, start, stride, array.name, column);
        break;
      case MAT_C_UINT16:
        Convert<std::uint16_t>(v, start, stride, array.name, column);
        break;
      case MAT_C_INT32:
        Convert<std::int32_t>(v, start, stride, array.name, column);
        break;
      case MAT_C_UINT32:
        Convert<std::uint32_t>(v, start, stride, array.name, column);
        break;
      case MAT_C_INT64:
        Convert<std::int64_t>(v, start, stride, array.name, column);
        break;
      default:
        Convert<std::uint64_t>(v, start, stride, array.name, column);
        break;
    }
    return column;
  }

  std::string file_;
  MatFile mat_;
  std::vector<ArrayInfo> arrays_;
};

}  // namespace

std::unique_ptr<TableSource> OpenMatTable(const std::filesystem::path& file) {
  const Hdf5Lock lock;
  return std::make_unique<MatTable>(file);
}

}  // namespace howl
