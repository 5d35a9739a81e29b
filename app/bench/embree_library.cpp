#if defined(ENCORE_HAVE_EMBREE)

#include "app/bench/embree_library.h"

#include <dlfcn.h>

#include <optional>

namespace encore::app::bench {

namespace {

std::optional<EmbreeLibrary> load() {
  void* library = dlopen("libembree3.so.3", RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) return std::nullopt;
  EmbreeLibrary functions;
  bool all = true;
#define ENCORE_EMBREE_LOAD(NAME)                                               \
  functions.NAME = reinterpret_cast<decltype(&::NAME)>(dlsym(library, #NAME)); \
  all = all && functions.NAME != nullptr;
  ENCORE_EMBREE_FUNCTIONS(ENCORE_EMBREE_LOAD)
#undef ENCORE_EMBREE_LOAD
  if (!all) return std::nullopt;
  return functions;
}

}  // namespace

const EmbreeLibrary* EmbreeLibrary::get() {
  static const std::optional<EmbreeLibrary> library = load();
  return library ? &*library : nullptr;
}

}  // namespace encore::app::bench

#endif
