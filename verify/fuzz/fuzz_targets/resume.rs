//! See `twofold_verify::fuzzing::resume`.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| twofold_verify::fuzzing::resume(bytes));
