//! See `twofold_command::fuzzing::scene`.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| twofold_command::fuzzing::scene(bytes));
