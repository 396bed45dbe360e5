#include "io/records/binary/mat_table.h"

#include <matio.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "io/records/binary/array_columns.h"
#include "io/records/binary/hdf5_lock.h"
#include "io/records/binary/hdf5_table.h"
#include "io/records/binary/mat5_check.h"
#include "io/records/binary/mat73_class.h"
#include "io/records/binary/survival.h"
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
      return "an array of structs";
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

bool IsSingleStruct(const matvar_t& variable) {
  std::size_t count = 1;
  for (int i = 0; i < variable.rank; ++i) count *= variable.dims[i];
  return variable.class_type == MAT_C_STRUCT && count == 1;
}

class MatTable final : public TableSource {
 public:
  explicit MatTable(const std::filesystem::path& file)
      : file_(file.string()), mat_(Mat_Open(file_.c_str(), MAT_ACC_RDONLY)) {
    if (!mat_) throw UserError(file_, 0, "", "not a readable MATLAB .mat file");
    if (Mat_GetVersion(mat_.get()) == MAT_FT_MAT5) CheckMat5(file);
    for (;;) {
      const Variable variable(Mat_VarReadNextInfo(mat_.get()));
      if (!variable) break;
      AddArrays(*variable, variable->name != nullptr ? variable->name : "");
    }
    std::sort(arrays_.begin(), arrays_.end(),
              [](const ArrayInfo& a, const ArrayInfo& b) { return a.name < b.name; });
  }

  bool IsVersion73() const { return Mat_GetVersion(mat_.get()) == MAT_FT_MAT73; }

  ~MatTable() override {
    const Hdf5Lock lock;
    mat_.reset();
  }

  Columns Read(const std::vector<ColumnName>& names) override {
    const Hdf5Lock lock;
    RequireSurvival(file_, [&] { ReadColumns(names); });
    return ReadColumns(names);
  }

  std::vector<ColumnInfo> List() const override { return ListChannels(arrays_); }
  std::string Format() const override {
    return IsVersion73() ? "a MATLAB 7.3 file" : "a MATLAB file";
  }

 private:
  Columns ReadColumns(const std::vector<ColumnName>& names) {
    Columns columns;
    for (const ArrayChannel& channel : FindChannels(file_, arrays_, names)) {
      columns.push_back(ReadChannel(arrays_[channel.array], channel.channel));
    }
    return columns;
  }

  // A struct has its fields in its place: rec.p, and of a struct within it rec.run.p.
  void AddArrays(matvar_t& variable, const std::string& name) {
    if (IsSingleStruct(variable)) {
      if (variable.data == nullptr) return;  // a damaged one, which matio would look into
      const unsigned count = Mat_VarGetNumberOfFields(&variable);
      char* const* const fields = Mat_VarGetStructFieldnames(&variable);
      for (unsigned i = 0; i < count; ++i) {
        matvar_t* const field = Mat_VarGetStructFieldByIndex(&variable, i, 0);
        if (field != nullptr) AddArrays(*field, name + "." + fields[i]);
      }
      return;
    }
    ArrayInfo array{name, 0, 0, Problem(variable)};
    if (variable.rank == 2) {
      array.rows = variable.dims[0];
      array.columns = variable.dims[1];
    }
    arrays_.push_back(array);
  }

  // matio reads a struct as a whole or not at all.
  std::vector<double> ReadField(const ArrayInfo& array, std::size_t channel) {
    std::size_t dot = array.name.find('.');
    const Variable whole(Mat_VarRead(mat_.get(), array.name.substr(0, dot).c_str()));
    matvar_t* field = whole.get();
    while (field != nullptr && dot != std::string::npos) {
      const std::size_t next = array.name.find('.', dot + 1);
      field =
          Mat_VarGetStructFieldByName(field, array.name.substr(dot + 1, next - dot - 1).c_str(), 0);
      dot = next;
    }
    const std::size_t numbers = array.rows * array.columns;
    if (field == nullptr || field->data == nullptr || field->data_size <= 0 ||
        field->nbytes < numbers * static_cast<std::size_t>(field->data_size)) {
      throw UserError(file_, 0, array.name, "cannot be read: damaged");
    }
    std::vector<double> column(array.samples());
    const auto copy = [&](const auto* from) {
      for (std::size_t i = 0; i < column.size(); ++i) {
        const std::size_t at =
            array.along_rows() ? channel * array.rows + i : i * array.rows + channel;
        column[i] = static_cast<double>(from[at]);
      }
    };
    switch (field->class_type) {
      case MAT_C_DOUBLE:
        copy(static_cast<const double*>(field->data));
        break;
      case MAT_C_SINGLE:
        copy(static_cast<const float*>(field->data));
        break;
      case MAT_C_INT8:
        copy(static_cast<const std::int8_t*>(field->data));
        break;
      case MAT_C_UINT8:
        copy(static_cast<const std::uint8_t*>(field->data));
        break;
      case MAT_C_INT16:
        copy(static_cast<const std::int16_t*>(field->data));
        break;
      case MAT_C_UINT16:
        copy(static_cast<const std::uint16_t*>(field->data));
        break;
      case MAT_C_INT32:
        copy(static_cast<const std::int32_t*>(field->data));
        break;
      case MAT_C_UINT32:
        copy(static_cast<const std::uint32_t*>(field->data));
        break;
      case MAT_C_INT64:
        copy(static_cast<const std::int64_t*>(field->data));
        break;
      default:
        copy(static_cast<const std::uint64_t*>(field->data));
        break;
    }
    return column;
  }

  // Numbers of the variable's own class.
  void ReadRaw(matvar_t* variable, const ArrayInfo& array, std::size_t channel, void* to) {
    const int rows = static_cast<int>(array.rows);
    const int place = static_cast<int>(channel);
    const int count = static_cast<int>(array.samples());
    int status = 0;
    if (IsVersion73()) {
      // Its linear read selects sample by sample: ten times slower, five times the memory.
      int start[2] = {0, place};
      int stride[2] = {1, 1};
      int edge[2] = {count, 1};
      if (!array.along_rows()) {
        std::swap(start[0], start[1]);
        std::swap(edge[0], edge[1]);
      }
      status = Mat_VarReadData(mat_.get(), variable, to, start, stride, edge);
    } else if (array.along_rows()) {
      status = Mat_VarReadDataLinear(mat_.get(), variable, to, place * rows, 1, count);
    } else {
      status = Mat_VarReadDataLinear(mat_.get(), variable, to, place, rows, count);
    }
    if (status != 0) throw UserError(file_, 0, array.name, "cannot be read: damaged");
  }

  template <typename T>
  void Convert(matvar_t* variable, const ArrayInfo& array, std::size_t channel,
               std::vector<double>& column) {
    std::vector<T> raw(column.size());
    ReadRaw(variable, array, channel, raw.data());
    for (std::size_t i = 0; i < raw.size(); ++i) column[i] = static_cast<double>(raw[i]);
  }

  std::vector<double> ReadChannel(const ArrayInfo& array, std::size_t channel) {
    if (array.name.find('.') != std::string::npos) return ReadField(array, channel);
    const Variable variable(Mat_VarReadInfo(mat_.get(), array.name.c_str()));
    if (!variable || array.rows * array.columns > std::numeric_limits<int>::max()) {
      throw UserError(file_, 0, array.name, "cannot be read: damaged, or 2^31 numbers or more");
    }
    std::vector<double> column(array.samples());
    if (column.empty()) return column;
    matvar_t* v = variable.get();
    switch (v->class_type) {
      case MAT_C_DOUBLE:
        ReadRaw(v, array, channel, column.data());
        break;
      case MAT_C_SINGLE:
        Convert<float>(v, array, channel, column);
        break;
      case MAT_C_INT8:
        Convert<std::int8_t>(v, array, channel, column);
        break;
      case MAT_C_UINT8:
        Convert<std::uint8_t>(v, array, channel, column);
        break;
      case MAT_C_INT16:
        Convert<std::int16_t>(v, array, channel, column);
        break;
      case MAT_C_UINT16:
        Convert<std::uint16_t>(v, array, channel, column);
        break;
      case MAT_C_INT32:
        Convert<std::int32_t>(v, array, channel, column);
        break;
      case MAT_C_UINT32:
        Convert<std::uint32_t>(v, array, channel, column);
        break;
      case MAT_C_INT64:
        Convert<std::int64_t>(v, array, channel, column);
        break;
      default:
        Convert<std::uint64_t>(v, array, channel, column);
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
  std::unique_ptr<MatTable> table;
  {
    const Hdf5Lock lock;
    RequireSurvival(file.string(), [&] {
      const auto* const probe = new MatTable(file);  // not deleted: that would wait for the lock
      if (probe->IsVersion73()) HasMatlabsOwnClasses(file);
    });
    table = std::make_unique<MatTable>(file);
    if (!table->IsVersion73() || HasMatlabsOwnClasses(file)) return table;
  }
  table.reset();
  return OpenHdf5Table(file, Hdf5Names::kMatlab);
}

}  // namespace howl
