//! See `twofold_command::fuzzing::data_file`.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| twofold_command::fuzzing::data_file(bytes));
