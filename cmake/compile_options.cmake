# Flags for our own targets only. Results must not depend on what a compiler fuses, so contraction is off. Nothing reads
# errno or traps on floating-point operations; saying so changes no value and lets square roots and minima vectorise.
# clang++ counts signed indices into std::array as conversions; g++ does not.
add_library(pdc_options INTERFACE)
target_compile_options(pdc_options INTERFACE -Wall -Wextra -Wshadow -Wconversion -Wno-sign-conversion -ffp-contract=off
  -fno-math-errno -fno-trapping-math)
if(PDC_WERROR)
  target_compile_options(pdc_options INTERFACE -Werror)
endif()

# Sanitizers look at the library and the program. The tests only link them: instrumented test programs take many times as
# long to compile and would find faults in the tests.
add_library(pdc_sanitizers INTERFACE)
if(PDC_SANITIZE)
  target_compile_options(pdc_sanitizers INTERFACE
    -fsanitize=${PDC_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(pdc_options INTERFACE -fsanitize=${PDC_SANITIZE})
endif()
