// Compiled into every test of the device. Vulkan drivers and layers keep memory until the process ends, which
// is no leak of ours; with AddressSanitizer their modules stay loaded, so that the reports name them and can be
// told apart from ours. The validation layer reports Vulkan objects that are not destroyed.
#ifdef __SANITIZE_ADDRESS__
extern "C" {

int dlclose(void* /*module*/) noexcept;
int dlclose(void* /*module*/) noexcept { return 0; }

const char* __lsan_default_suppressions();
const char* __lsan_default_suppressions() {
  return "leak:libvulkan\n"
         "leak:libVkLayer\n"
         "leak:libLLVM\n";
}

const char* __lsan_default_options();
const char* __lsan_default_options() { return "print_suppressions=0"; }

}  // extern "C"
#endif
