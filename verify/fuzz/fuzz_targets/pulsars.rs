//! See `twofold_verify::fuzzing::pulsars`.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| twofold_verify::fuzzing::pulsars(bytes));
