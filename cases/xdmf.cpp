#include "cases/xdmf.hpp"

#include <fmt/format.h>

#include <iterator>

namespace nilas::cases {
namespace {

/// An array of the file, all times one after the other.
struct Array {
  std::string path;  // file:/group/dataset
  int components;
  int bytes;  // per number
};

/// The rows of one time. XDMF 2 states a hyperslab as start, stride, count.
void append_slab(std::string& text, const Array& array, std::size_t time, std::size_t times, std::size_t particles) {
  fmt::format_to(std::back_inserter(text),
                 "        <DataItem ItemType=\"HyperSlab\" Dimensions=\"{1} {2}\">\n"
                 "          <DataItem Dimensions=\"3 2\" Format=\"XML\">{0} 0  1 1  {1} {2}</DataItem>\n"
                 "          <DataItem Dimensions=\"{3} {2}\" NumberType=\"Float\" Precision=\"{4}\" Format=\"HDF\">"
                 "{5}</DataItem>\n"
                 "        </DataItem>\n",
                 time * particles, particles, array.components, times * particles, array.bytes, array.path);
}

}  // namespace

std::string xdmf(const std::string& hdf5_file, const std::vector<double>& times, std::size_t particles,
                 const std::vector<XdmfField>& fields) {
  std::string text =
      "<?xml version=\"1.0\"?>\n"
      "<!DOCTYPE Xdmf SYSTEM \"Xdmf.dtd\" []>\n"
      "<!-- ParaView: choose the reader called Xdmf Reader; its Xdmf3 readers ignore hyperslabs and show nothing. -->\n"
      "<Xdmf Version=\"2.0\">\n"
      " <Domain>\n"
      "  <Grid Name=\"ice\" GridType=\"Collection\" CollectionType=\"Temporal\">\n";
  for (std::size_t time = 0; time < times.size(); ++time) {
    text += fmt::format(
        "   <Grid Name=\"ice\" GridType=\"Uniform\">\n"
        "      <Time Value=\"{}\"/>\n"
        "      <Topology TopologyType=\"Polyvertex\" NumberOfElements=\"{}\" NodesPerElement=\"1\"/>\n"
        "      <Geometry GeometryType=\"XYZ\">\n",
        times[time], particles);
    append_slab(text, {hdf5_file + ":/VTKHDF/Points", 3, 8}, time, times.size(), particles);
    text += "      </Geometry>\n";
    for (const XdmfField& field : fields) {
      text += fmt::format("      <Attribute Name=\"{}\" AttributeType=\"{}\" Center=\"Node\">\n", field.name,
                          field.components == 3 ? "Vector" : "Scalar");
      append_slab(text, {hdf5_file + ":/VTKHDF/PointData/" + field.name, field.components, 4}, time, times.size(),
                  particles);
      text += "      </Attribute>\n";
    }
    text += "   </Grid>\n";
  }
  return text + "  </Grid>\n </Domain>\n</Xdmf>\n";
}

}  // namespace nilas::cases
