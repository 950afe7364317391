//! See `twofold_command::fuzzing::command_line`.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| twofold_command::fuzzing::command_line(bytes));
