//! See `twofold_verify::fuzzing::data_file`.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| twofold_verify::fuzzing::data_file(bytes));
