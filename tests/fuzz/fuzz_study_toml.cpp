// Feeds arbitrary bytes to the reader of study files: a study with groups that hold something, or
// InputError.
#include "app/study_file.h"
#include "tests/fuzz/check_text.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace encore;
  fuzz::check_parser<scene::InputError>([&] {
    const app::Study study = app::parse_study(fuzz::text_of(data, size), "fuzz.toml");
    fuzz::require(!study.groups.empty());
    for (const app::StudyGroup& group : study.groups) {
      fuzz::require(!group.name.empty() && !group.scenes.empty() && !group.structures.empty() &&
                    !group.sizes.empty() && group.threads >= 0);
    }
    fuzz::require_finite(study.measuring.seconds);
    fuzz::require_finite(study.measuring.poll);
  });
  return 0;
}
