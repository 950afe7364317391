//! See `twofold_verify::fuzzing::scene`.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| twofold_verify::fuzzing::scene(bytes));
