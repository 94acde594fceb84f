#include <fcntl.h>
#include <io.h>
// The second needs the first.
// clang-format off
#include <windows.h>
#include <shellapi.h>
// clang-format on

#include <algorithm>
#include <cstdio>

#include "slipface/base/system.h"

namespace slipface {
namespace {

std::string utf8_of(std::wstring_view text) {
    const int size = static_cast<int>(text.size());
    std::string bytes(
        static_cast<std::size_t>(
            std::max(0, ::WideCharToMultiByte(CP_UTF8, 0, text.data(), size, nullptr, 0, nullptr, nullptr))),
        '\0');
    ::WideCharToMultiByte(CP_UTF8, 0, text.data(), size, bytes.data(), static_cast<int>(bytes.size()),
                          nullptr, nullptr);
    return bytes;
}

}  // namespace

std::filesystem::path path_of(std::string_view text) {
    const int size = static_cast<int>(std::min<std::size_t>(text.size(), 1U << 20));
    std::wstring wide(static_cast<std::size_t>(
                          std::max(0, ::MultiByteToWideChar(CP_UTF8, 0, text.data(), size, nullptr, 0))),
                      L'\0');
    ::MultiByteToWideChar(CP_UTF8, 0, text.data(), size, wide.data(), static_cast<int>(wide.size()));
    return std::filesystem::path(std::move(wide));
}

// What main() gets is spelled in the machine's old code page, which has not all letters.
std::vector<std::string> begin_program(int argument_count, char** arguments) {
    for (std::FILE* const file : {stdin, stdout, stderr})
        ::_setmode(::_fileno(file), _O_BINARY);
    ::SetConsoleOutputCP(CP_UTF8);
    int count = 0;
    wchar_t** const wide = ::CommandLineToArgvW(::GetCommandLineW(), &count);
    if (wide == nullptr) return {arguments, arguments + argument_count};
    std::vector<std::string> words;
    for (int i = 0; i < count; ++i)
        words.push_back(utf8_of(wide[i]));
    ::LocalFree(wide);
    return words;
}

}  // namespace slipface
