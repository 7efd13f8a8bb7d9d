// Extractions for tests: prepare a mesh, run it on the device or with the reference, evaluate the certificate.
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <map>
#include <string>

#include "cpu_reference/extract.h"
#include "medial_vk/certify.h"
#include "medial_vk/context.h"
#include "medial_vk/indexed_mesh.h"
#include "medial_vk/mesh.h"
#include "support/eigen_points.h"

namespace medial_vk::test {

/// prepare_mesh() of a mesh that must be good; throws std::runtime_error (a test failure) if it is not.
PreparedMesh prepare(Mesh mesh);

/// A context that leaves the user's pipeline cache alone; throws without a device: call no_device_reason() first.
Context make_context(bool validation = false);

/// extract_and_certify() on the device, on one host thread; throws with the error's message, or if two points share a
/// voxel or counts contradict each other.
CertifiedExtraction extract_on_device(Context& context, const PreparedMesh& mesh, const ExtractionOptions& options);

/// The same on the side, and in the box, of the mesh.
CertifiedExtraction extract_on_device(Context& context, const IndexedMesh& mesh, const ExtractionOptions& options);

/// The independent reference with the same options: double precision, certified inside.
reference::Result extract_with_reference(const PreparedMesh& mesh, const ExtractionOptions& options);

/// Whether every sphere passes every condition of the certificate, recomputed by the reference. The message names the
/// conditions that fail and the first sphere of each.
testing::AssertionResult passes_certificate(const PreparedMesh& mesh, const Extraction& extraction,
                                            const ExtractionOptions& options);

/// The same for spheres of the reference's mesh, which may be the outside of another.
testing::AssertionResult passes_certificate(const reference::Mesh& mesh, const Extraction& extraction,
                                            const ExtractionOptions& options);

/// Counters and times in one line, for the messages of failed tests.
std::string describe(const CertifiedExtraction& result);

using Voxel = std::array<int, 3>;
/// Index of the sphere by its voxel.
using SphereByVoxel = std::map<Voxel, std::size_t>;
SphereByVoxel spheres_by_voxel(const Extraction& extraction);

/// The voxel of a point, as the medial PLY defines it.
Voxel voxel_of(const VoxelGrid& grid, const Eigen::Vector3d& p);
/// Distance from a point to the faces of its voxel, as a fraction of the voxel's side: 0 to 1/2.
double depth_in_voxel(const VoxelGrid& grid, const Eigen::Vector3d& p);

}  // namespace medial_vk::test
