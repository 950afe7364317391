//! See `twofold_command::fuzzing::timing_file`.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| twofold_command::fuzzing::timing_file(bytes));
