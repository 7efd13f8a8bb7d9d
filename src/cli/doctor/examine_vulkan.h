// The Vulkan loader, its drivers and their devices, each in a process of its own.
#pragma once

#include <chrono>

#include "output/doctor_report/doctor_record.h"

namespace medial_vk::cli {

/// Opens the loader as the library does. Creates no instance, so that no driver runs.
LoaderRecord examine_loader(std::chrono::milliseconds limit);

/// Lists the devices of all drivers, as a run does.
void list_devices(std::chrono::milliseconds limit, DoctorRecord& record);

/// Opens the library of the driver, and lists the devices of this driver alone.
void examine_driver(std::chrono::milliseconds limit, DriverRecord& driver);

}  // namespace medial_vk::cli
