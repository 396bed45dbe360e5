// SHA-256 of texts and files, and a text that only who knows a passphrase can read (AES-256-GCM:
// a change of the sealed text is noticed when it is opened).
#ifndef HOWL_APP_FILES_DIGEST_H_
#define HOWL_APP_FILES_DIGEST_H_

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace howl {

std::string Sha256(std::string_view text);  // 64 hexadecimal digits
// Empty where the file cannot be read.
std::optional<std::string> Sha256OfFile(const std::filesystem::path& path);

// The cipher's key is the passphrase's SHA-256; the passphrase is to be as long as a random one.
std::string SealText(std::string_view text, std::string_view passphrase);
// Empty where the passphrase is another, or the sealed text has changed.
std::optional<std::string> OpenText(std::string_view sealed, std::string_view passphrase);

}  // namespace howl

#endif  // HOWL_APP_FILES_DIGEST_H_
