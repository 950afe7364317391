//! See `twofold_command::fuzzing::authors_data`.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| twofold_command::fuzzing::authors_data(bytes));
