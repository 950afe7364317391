//! See `twofold_command::fuzzing::timing_model`.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| twofold_command::fuzzing::timing_model(bytes));
