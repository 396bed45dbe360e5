#include "app/files/digest.h"

#include <glog/logging.h>
#include <openssl/evp.h>

#include <algorithm>
#include <array>
#include <memory>

#include "io/whole_file.h"

namespace howl {
namespace {

constexpr std::size_t kKeyBytes = 32;
constexpr std::size_t kNonceBytes = 12;
constexpr std::size_t kTagBytes = 16;

using Cipher = std::unique_ptr<EVP_CIPHER_CTX, decltype(&EVP_CIPHER_CTX_free)>;
using Key = std::array<unsigned char, kKeyBytes>;

Key Hash(std::string_view text) {
  Key out{};
  unsigned int size = 0;
  CHECK_EQ(EVP_Digest(text.data(), text.size(), out.data(), &size, EVP_sha256(), nullptr), 1);
  CHECK_EQ(size, out.size());
  return out;
}

const unsigned char* Bytes(const char* text) {
  return reinterpret_cast<const unsigned char*>(text);
}
unsigned char* Bytes(char* text) { return reinterpret_cast<unsigned char*>(text); }

}  // namespace

std::string Sha256(std::string_view text) {
  constexpr const char* kDigits = "0123456789abcdef";
  std::string out;
  for (const unsigned char byte : Hash(text)) {
    out += kDigits[byte >> 4];
    out += kDigits[byte & 15];
  }
  return out;
}

std::optional<std::string> Sha256OfFile(const std::filesystem::path& path) {
  const std::optional<std::string> text = ReadWholeFile(path);
  if (!text) return std::nullopt;
  return Sha256(*text);
}

std::string SealText(std::string_view text, std::string_view passphrase) {
  const Key key = Hash(passphrase);
  std::string out(kNonceBytes + kTagBytes + text.size(), '\0');
  // One text and one passphrase give one sealed text, so that shards of a trial join to the bytes
  // of one machine; another text has another nonce, as the cipher needs.
  const Key nonce = Hash(std::string(passphrase) + "\n" + std::string(text));
  std::copy_n(nonce.begin(), kNonceBytes, Bytes(out.data()));
  const Cipher cipher(EVP_CIPHER_CTX_new(), EVP_CIPHER_CTX_free);
  int written = 0;
  CHECK_EQ(
      EVP_EncryptInit_ex(cipher.get(), EVP_aes_256_gcm(), nullptr, key.data(), Bytes(out.data())),
      1);
  unsigned char* body = Bytes(out.data()) + kNonceBytes + kTagBytes;
  CHECK_EQ(EVP_EncryptUpdate(cipher.get(), body, &written, Bytes(text.data()),
                             static_cast<int>(text.size())),
           1);
  CHECK_EQ(EVP_EncryptFinal_ex(cipher.get(), body + written, &written), 1);
  CHECK_EQ(EVP_CIPHER_CTX_ctrl(cipher.get(), EVP_CTRL_GCM_GET_TAG, kTagBytes,
                               Bytes(out.data()) + kNonceBytes),
           1);
  return out;
}

std::optional<std::string> OpenText(std::string_view sealed, std::string_view passphrase) {
  if (sealed.size() < kNonceBytes + kTagBytes) return std::nullopt;
  const Key key = Hash(passphrase);
  const Cipher cipher(EVP_CIPHER_CTX_new(), EVP_CIPHER_CTX_free);
  CHECK_EQ(EVP_DecryptInit_ex(cipher.get(), EVP_aes_256_gcm(), nullptr, key.data(),
                              Bytes(sealed.data())),
           1);
  std::array<unsigned char, kTagBytes> tag{};
  std::copy_n(Bytes(sealed.data()) + kNonceBytes, kTagBytes, tag.begin());
  const std::string_view body = sealed.substr(kNonceBytes + kTagBytes);
  std::string out(body.size(), '\0');
  int written = 0;
  CHECK_EQ(EVP_DecryptUpdate(cipher.get(), Bytes(out.data()), &written, Bytes(body.data()),
                             static_cast<int>(body.size())),
           1);
  CHECK_EQ(EVP_CIPHER_CTX_ctrl(cipher.get(), EVP_CTRL_GCM_SET_TAG, kTagBytes, tag.data()), 1);
  if (EVP_DecryptFinal_ex(cipher.get(), Bytes(out.data()) + written, &written) != 1) {
    return std::nullopt;
  }
  return out;
}

}  // namespace howl
