//! The command, run as its users run it.

mod bounds;
mod command;
mod common;
mod compare;
#[cfg(target_os = "linux")]
mod faults;
mod figures;
mod golden;
mod inference;
mod limits;
mod notes;
mod plans;
mod pulses;
mod second_program;
mod sessions;
#[cfg(target_os = "linux")]
mod signals;
mod spectrum;
mod sweep;
mod timing;
#[cfg(unix)]
mod worked_pages;
