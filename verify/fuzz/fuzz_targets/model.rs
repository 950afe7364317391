//! See `twofold_verify::fuzzing::model`.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| twofold_verify::fuzzing::model(bytes));
