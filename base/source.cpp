#include "base/source.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "base/os/os.h"
#include "base/text.h"

namespace cnctrans {
namespace {

constexpr std::string_view bom = "\xEF\xBB\xBF";
// Below this a copy costs less than a mapping.
constexpr std::size_t map_from_bytes = 1U << 20U;

bool read_all(const os::ReadFile& file, std::string* out, std::string* error) {
  std::size_t used = 0;
  out->resize(file.size() + 1);  // one more byte, so that the end is seen without growing
  for (;;) {
    if (used == out->size()) out->resize(out->size() * 2 + 4096);
    const std::ptrdiff_t n = file.read(out->data() + used, out->size() - used, error);
    if (n < 0) return false;
    if (n == 0) break;
    used += static_cast<std::size_t>(n);
  }
  out->resize(used);
  return true;
}

/// Place of the first LF or CR; npos when there is none. In growing steps, so that a file without LF is not searched
/// to its end for each of its lines.
std::size_t find_line_end(std::string_view text) {
  std::size_t start = 0;
  for (std::size_t step = 128; start < text.size(); step *= 2) {
    const std::size_t n = std::min(step, text.size() - start);
    const char* const p = text.data() + start;
    const void* const lf = std::memchr(p, '\n', n);
    const std::size_t before_lf = lf != nullptr ? static_cast<std::size_t>(static_cast<const char*>(lf) - p) : n;
    if (const void* const cr = std::memchr(p, '\r', before_lf))
      return start + static_cast<std::size_t>(static_cast<const char*>(cr) - p);
    if (lf != nullptr) return start + before_lf;
    start += n;
  }
  return std::string_view::npos;
}

}  // namespace

std::shared_ptr<const SourceText> SourceText::open(const std::string& path, std::string* error) {
  auto file = std::make_unique<os::ReadFile>();
  if (!file->open(path, error)) return nullptr;
  std::shared_ptr<SourceText> s(new SourceText);  // the constructor is private
  s->name_ = path;
  if (file->size() >= map_from_bytes && !file->map().empty()) {
    s->file_ = std::move(file);
    s->set_bytes(s->file_->map());
    return s;
  }
  if (!read_all(*file, &s->owned_, error)) return nullptr;
  s->set_bytes(s->owned_);
  return s;
}

std::shared_ptr<const SourceText> SourceText::from_string(std::string name, std::string bytes) {
  std::shared_ptr<SourceText> s(new SourceText);  // the constructor is private
  s->name_ = std::move(name);
  s->owned_ = std::move(bytes);
  s->set_bytes(s->owned_);
  return s;
}

std::shared_ptr<const SourceText> SourceText::from_lines(std::string name, std::string bytes,
                                                         std::vector<std::uint32_t> numbers, std::uint32_t last) {
  std::shared_ptr<SourceText> s(new SourceText);  // the constructor is private
  s->name_ = std::move(name);
  s->owned_ = std::move(bytes);
  s->numbers_ = std::move(numbers);
  s->last_ = last;
  s->set_bytes(s->owned_);
  return s;
}

SourceText::~SourceText() = default;

void SourceText::set_bytes(std::string_view bytes) {
  bytes_ = bytes;
  has_bom_ = bytes.substr(0, bom.size()) == bom;
  encoding_ = valid_utf8(bytes) ? Encoding::utf8 : Encoding::windows1252;
  SourceLine first;
  std::string_view rest = text();
  if (take_line(rest, first)) eol_ = first.eol;
}

std::string_view SourceText::text() const {
  return has_bom_ ? bytes_.substr(bom.size()) : bytes_;
}

std::string SourceText::stem() const {
  const auto slash = name_.rfind('/');
  std::string file = slash == std::string::npos ? name_ : name_.substr(slash + 1);
  const auto dot = file.rfind('.');
  if (dot != std::string::npos && dot != 0) file.resize(dot);
  return file;
}

std::string SourceText::extension() const {
  const auto slash = name_.rfind('/');
  const std::string file = slash == std::string::npos ? name_ : name_.substr(slash + 1);
  const auto dot = file.rfind('.');
  if (dot == std::string::npos || dot == 0) return {};
  std::string ext = file.substr(dot + 1);
  for (char& c : ext) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return ext;
}

const std::vector<SourceLine>& SourceText::lines() const {
  std::call_once(lines_once_, [this] {
    std::string_view rest = text();
    lines_.reserve(rest.size() / 24 + 1);
    SourceLine line;
    while (take_line(rest, line)) lines_.push_back(line);
    for (std::size_t i = 0; i < numbers_.size(); ++i) lines_[i].number = numbers_[i];
  });
  return lines_;
}

std::uint32_t SourceText::last_line() const {
  return numbers_.empty() ? static_cast<std::uint32_t>(lines().size()) : last_;
}

std::string_view SourceText::line_text(std::uint32_t number) const {
  const auto& all = lines();
  const auto it = std::lower_bound(all.begin(), all.end(), number,
                                   [](const SourceLine& l, std::uint32_t n) { return l.number < n; });
  return it != all.end() && it->number == number ? it->text : std::string_view{};
}

FileId FileTable::add(SourcePtr source) {
  std::string name = source ? source->name() : std::string{};
  files_.push_back({std::move(name), std::move(source)});
  return static_cast<FileId>(files_.size() - 1);
}

FileId FileTable::add_name(std::string name) {
  files_.push_back({std::move(name), nullptr});
  return static_cast<FileId>(files_.size() - 1);
}

void FileTable::attach(FileId id, SourcePtr source) {
  if (id != 0 && id < files_.size()) files_[id].source = std::move(source);
}

const std::string& FileTable::name(FileId id) const {
  return files_[id < files_.size() ? id : 0].name;
}

const SourceText* FileTable::source(FileId id) const {
  return files_[id < files_.size() ? id : 0].source.get();
}

SourcePtr FileTable::source_ptr(FileId id) const {
  return files_[id < files_.size() ? id : 0].source;
}

struct LineWindowReader::State {
  explicit State(std::size_t window) : buffer(std::max<std::size_t>(window, 2)) {}

  std::vector<char> buffer;
  std::size_t used = 0;   ///< bytes in the buffer
  std::size_t given = 0;  ///< of them, the bytes of the last window
  bool at_end = false;    ///< nothing more to read
  std::size_t read = 0;   ///< bytes read from the file so far
  std::string error;
  std::unique_ptr<os::ReadFile> file;

  /// Fills the buffer, or comes to the end of the file.
  void fill() {
    while (!at_end && used < buffer.size()) {
      const std::ptrdiff_t n = file->read(buffer.data() + used, buffer.size() - used, &error);
      at_end = n <= 0;
      const std::size_t got = n > 0 ? static_cast<std::size_t>(n) : 0;
      used += got;
      read += got;
    }
  }

  /// Bytes up to and with the last line end in the buffer; 0 when there is none. A CR at the very end may be the
  /// first half of a CRLF, and waits for the next byte.
  [[nodiscard]] std::size_t whole_lines() const {
    const std::string_view all(buffer.data(), used);
    const std::size_t after_lf = all.rfind('\n') + 1;  // 0: there is none
    if (after_lf == used) return used;
    const std::size_t cr = all.substr(after_lf, used - 1 - after_lf).rfind('\r');
    return cr != std::string_view::npos ? after_lf + cr + 1 : after_lf;
  }
};

LineWindowReader::LineWindowReader(std::size_t window_bytes) : state_(std::make_unique<State>(window_bytes)) {}
LineWindowReader::~LineWindowReader() = default;

bool LineWindowReader::open(const std::string& path, std::string* error) {
  auto file = std::make_unique<os::ReadFile>();
  if (!file->open(path, error)) return false;
  file->read_in_order();
  state_ = std::make_unique<State>(state_->buffer.size());
  state_->file = std::move(file);
  return true;
}

std::string_view LineWindowReader::next() {
  State& s = *state_;
  if (!s.file) return {};
  std::memmove(s.buffer.data(), s.buffer.data() + s.given, s.used - s.given);
  s.used -= s.given;
  for (;;) {
    s.fill();
    s.given = s.at_end ? s.used : s.whole_lines();
    if (s.given != 0 || s.at_end) break;
    s.buffer.resize(s.buffer.size() * 2);
  }
  return {s.buffer.data(), s.given};
}

void LineWindowReader::give_back(std::size_t bytes) {
  state_->given -= bytes;
}

const std::string& LineWindowReader::read_error() const {
  return state_->error;
}
std::size_t LineWindowReader::bytes_read() const {
  return state_->read;
}
std::size_t LineWindowReader::file_size() const {
  return state_->file == nullptr ? 0 : state_->file->size();
}

bool take_line(std::string_view& text, SourceLine& line) {
  if (text.empty()) return false;
  const std::size_t end = find_line_end(text);
  ++line.number;
  line.has_eol = end != std::string_view::npos;
  line.text = text.substr(0, end);
  if (!line.has_eol) {
    line.eol = Eol::lf;
    text = {};
    return true;
  }
  const bool cr = text[end] == '\r';
  const bool crlf = cr && end + 1 < text.size() && text[end + 1] == '\n';
  line.eol = crlf ? Eol::crlf : cr ? Eol::cr : Eol::lf;
  text.remove_prefix(end + (crlf ? 2 : 1));
  return true;
}

std::string_view eol_text(Eol eol) {
  switch (eol) {
    case Eol::crlf: return "\r\n";
    case Eol::cr: return "\r";
    case Eol::lf: break;
  }
  return "\n";
}

}  // namespace cnctrans
