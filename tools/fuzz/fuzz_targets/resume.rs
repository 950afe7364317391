//! See `twofold_command::fuzzing::resume`.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| twofold_command::fuzzing::resume(bytes));
