// The last step of a post-processor: a program that was made in memory goes to another control, proved.
// usage: post FAGOR-PROGRAM sinumerik|num
#include <fstream>
#include <iostream>
#include <iterator>

#include "cnctrans/api.h"

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  std::ifstream file(argv[1], std::ios::binary);
  const std::string made(std::istreambuf_iterator<char>(file), {});

  cnctrans::api::TranslateOptions options;
  options.from = "fagor";
  options.to = argv[2];
  options.verify = true;  // what can't be proved is not taken either
  options.one_file = true;
  const std::string path = argv[1];
  const auto result = cnctrans::api::translate(cnctrans::api::text(path.substr(path.rfind('/') + 1), made), options);

  for (const auto& d : result.diagnostics) std::cerr << d.shown;
  if (!result.error.empty()) std::cerr << result.error << '\n';
  if (result.verdict) std::cerr << result.verdict->text << '\n';
  if (result.status != cnctrans::api::Status::ok) return static_cast<int>(result.status);
  for (const auto& output : result.outputs) std::cout << output.bytes;
}
