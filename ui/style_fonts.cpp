#include "ui/style.h"

#include <array>
#include <cmath>
#include <cstdlib>
#include <string>

namespace encore::ui {

namespace {

namespace fs = std::filesystem;

/// Pairs of first and last character, as Dear ImGui takes them; lives as long as the atlas.
constexpr std::array<ImWchar, 21> kGlyphs{
    0x0020, 0x017F,  // Latin with its letters of Europe
    0x0370, 0x03FF,  // Greek
    0x2010, 0x2027,  // dashes, quotation marks, bullet, ellipsis
    0x2030, 0x2044,  // per mille, primes, fraction slash
    0x2070, 0x209F,  // superscripts, subscripts
    0x2190, 0x2195,  // arrows
    0x2202, 0x2265,  // mathematical signs
    0x25A0, 0x25FF,  // squares, triangles, circles
    0x26A0, 0x26A1,  // warning sign, lightning
    0x2713, 0x2718,  // check marks and crosses
    0};

std::array<fs::path, 8> font_folders() {
  const char* home = std::getenv("HOME");
  const char* data = std::getenv("XDG_DATA_HOME");
  const fs::path own = home != nullptr && home[0] == '/' ? fs::path(home) : fs::path();
  const fs::path user = data != nullptr && data[0] == '/' ? fs::path(data)
                        : own.empty()                     ? fs::path()
                                                          : own / ".local/share";
  return {user.empty() ? fs::path() : user / "fonts",
          own.empty() ? fs::path() : own / ".fonts",
          "/usr/share/fonts/truetype/dejavu",
          "/usr/share/fonts/dejavu-sans-fonts",
          "/usr/share/fonts/dejavu-sans-mono-fonts",
          "/usr/share/fonts/dejavu",
          "/usr/share/fonts/TTF",
          "/usr/local/share/fonts"};
}

/// The font of a file, or Dear ImGui's own at the same size.
bool add_font(const char* file_name, float pixels) {
  ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
  if (const auto file = find_font(file_name)) {
    ImFontConfig config;
    // Large letters are smooth without.
    config.OversampleH = pixels < 28.0F ? 2 : 1;
    config.OversampleV = 1;
    config.PixelSnapH = true;
    if (atlas.AddFontFromFileTTF(file->string().c_str(), pixels, &config, kGlyphs.data()) !=
        nullptr) {
      return true;
    }
  }
  ImFontConfig config;
  config.SizePixels = std::round(pixels * 13.0F / kFontPixels);
  atlas.AddFontDefault(&config);
  return false;
}

ImFont* font_at(int place) {
  const ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
  return place < atlas.Fonts.Size ? atlas.Fonts[place] : ImGui::GetFont();
}

}  // namespace

std::optional<fs::path> find_font(const char* file_name) {
  for (const fs::path& folder : font_folders()) {
    if (folder.empty()) continue;
    std::error_code error;
    fs::path file = folder / file_name;
    if (fs::is_regular_file(file, error)) return file;
  }
  return std::nullopt;
}

FontReport rebuild_fonts(float scale) {
  ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
  atlas.Clear();
  // Some drivers take no textures wider than this.
  atlas.TexDesiredWidth = 2048;
  const float pixels = std::round(kFontPixels * scale);
  FontReport report;
  report.sans = add_font("DejaVuSans.ttf", pixels);
  report.mono = add_font("DejaVuSansMono.ttf", std::round(pixels * 0.93F));
  report.bold = add_font("DejaVuSans-Bold.ttf", std::round(pixels * 1.2F));
  atlas.Build();
  return report;
}

ImFont* mono_font() {
  return font_at(1);
}

ImFont* heading_font() {
  return font_at(2);
}

}  // namespace encore::ui
