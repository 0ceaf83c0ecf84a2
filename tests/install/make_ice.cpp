// A plugin that brings nilas along, as a host would load it.
#include "coupling/ice_plugin.hpp"

extern "C" [[gnu::visibility("default")]] nilas::IcePlugin* make_ice() {
  return new nilas::IcePlugin(nilas::sph::IceSpec());
}
