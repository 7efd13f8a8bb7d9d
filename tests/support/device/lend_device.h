// The device of a context, lent in the way of a host.
#pragma once

#include "device/context_impl.h"
#include "medial_vk/host_device.h"

namespace medial_vk::test {

inline HostDevice lend_device(const ContextImpl& owner) {
  HostDevice host;
  host.instance = owner.instance;
  host.physical_device = owner.physical_device;
  host.device = owner.device;
  host.queue = owner.queue;
  host.queue_family = owner.queue_family;
  host.cache_folder = "/dev/null";
  return host;
}

}  // namespace medial_vk::test
