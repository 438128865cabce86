// How a kernel knows which item of a dispatch it works on.
#ifndef IMPORTON_LIB_DISPATCH_GLSL
#define IMPORTON_LIB_DISPATCH_GLSL

// The workgroup size is specialization constant 0; the host gives it 64 unless the kernel declares another
// default (`layout(local_size_x = 256) in;`) or the Kernel's specialization says otherwise. It is declared here
// because glslang takes gl_WorkGroupSize for 1 when a function uses it ahead of the declaration.
layout(local_size_x_id = 0) in;

/// Vulkan promises at least this many workgroups per dimension on every device.
const uint kGuaranteedWorkgroups = 65535u;

/// Linear index of this invocation. Long dispatches continue in y (gpu::Recorder::dispatch, dispatchGroups), so
/// the last workgroups may lie past the end: the kernel compares with its count.
uint invocationIndex() {
  const uint workgroup = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
  return workgroup * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
}

/// The workgroup counts that an indirect dispatch of `invocations` needs, for workgroups of `workgroupSize`.
uvec3 dispatchGroups(uint invocations, uint workgroupSize) {
  const uint groups = invocations / workgroupSize + uint(invocations % workgroupSize != 0u);
  if (groups <= kGuaranteedWorkgroups) return uvec3(groups, 1u, 1u);
  const uint rows = (groups + kGuaranteedWorkgroups - 1u) / kGuaranteedWorkgroups;
  return uvec3((groups + rows - 1u) / rows, rows, 1u);
}

#endif
