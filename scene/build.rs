//! Tells the command which compiler and target it was built with, for the environment of its report.

use std::process::Command;

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    let variable = |name| std::env::var(name).unwrap_or_default();
    let version = Command::new(variable("RUSTC")).arg("--version").output();
    let version =
        version.map_or_else(|_| "unknown".into(), |output| String::from_utf8_lossy(&output.stdout).into_owned());
    println!("cargo::rustc-env=TWOFOLD_RUSTC={}", version.trim());
    println!("cargo::rustc-env=TWOFOLD_TARGET={}", variable("TARGET"));
}
