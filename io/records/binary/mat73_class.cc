#include "io/records/binary/mat73_class.h"

// The form of H5O_info_t that 1.10 and later have in common.
#define H5O_info_t_vers 1
#include <hdf5.h>

#include <algorithm>
#include <vector>

namespace howl {
namespace {

constexpr const char* kClass = "MATLAB_class";

bool IsMatlabsOwn(hid_t attribute) {
  const hid_t type = H5Aget_type(attribute);
  const hid_t space = H5Aget_space(attribute);
  bool own = H5Tget_class(type) == H5T_STRING && H5Tis_variable_str(type) == 0 &&
             H5Sget_simple_extent_npoints(space) == 1;
  // A text that is padded, not ended, loses its last letter where matio asks for one that is ended.
  if (own && H5Tget_strpad(type) != H5T_STR_NULLTERM) {
    std::vector<char> text(H5Tget_size(type));
    own = H5Aread(attribute, type, text.data()) >= 0 &&
          std::find(text.begin(), text.end(), '\0') != text.end();
  }
  H5Sclose(space);
  H5Tclose(type);
  return own;
}

// Stops the visit, with 1, at the first variable whose class is not. What begins with # belongs to
// cells and objects, not to the user.
herr_t Visit(hid_t root, const char* name, const H5O_info_t* info, void* /*data*/) {
  if (*name == '#') return 0;
  if (H5Aexists_by_name(root, name, kClass, H5P_DEFAULT) <= 0) {
    return info->type == H5O_TYPE_DATASET ? 1 : 0;
  }
  const hid_t attribute = H5Aopen_by_name(root, name, kClass, H5P_DEFAULT, H5P_DEFAULT);
  if (attribute < 0) return 0;
  const bool own = IsMatlabsOwn(attribute);
  H5Aclose(attribute);
  return own ? 0 : 1;
}

}  // namespace

bool HasMatlabsOwnClasses(const std::filesystem::path& file) {
  const hid_t root = H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  if (root < 0) return true;  // damaged: matio says how
  const herr_t stopped =
      H5Ovisit2(root, H5_INDEX_NAME, H5_ITER_INC, Visit, nullptr, H5O_INFO_BASIC);
  H5Fclose(root);
  return stopped <= 0;
}

}  // namespace howl
