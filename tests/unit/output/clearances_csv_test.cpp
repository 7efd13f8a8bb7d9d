// The table of `medial-vk clearance`: columns, states, numbers, and names in quotes.
#include "output/distance_files/clearances_csv.h"

#include <gtest/gtest.h>

#include <limits>

namespace medial_vk {
namespace {

TEST(ClearancesCsv, ALinePerConfiguration) {
  const double inf = std::numeric_limits<double>::infinity();
  const Clearance clearances[] = {
      {0.1, 0.25, "base", "wrist"}, {0, 0, "a", "scene, left.obj"}, {0, 1e-17, "a \"b\"", "c"}, {0.5, inf, "", ""}};
  EXPECT_EQ(encode_clearances_csv(clearances),
            "configuration,state,lower,upper,first,second\n"
            "1,free,0.1,0.25,base,wrist\n"
            "2,hit,0,0,a,\"scene, left.obj\"\n"
            "3,undecided,0,1e-17,\"a \"\"b\"\"\",c\n"
            "4,free,0.5,inf,,\n");
  EXPECT_EQ(encode_clearances_csv({}), "configuration,state,lower,upper,first,second\n");
}

}  // namespace
}  // namespace medial_vk
