//! Scenes that come with the command: the paper's four examples and six other kinds of motion.

/// A scene inside the program.
#[derive(Debug, Clone, Copy)]
pub struct BuiltIn {
    /// Name for `twofold run`.
    pub name: &'static str,
    /// Text of the scene file.
    pub toml: &'static str,
}

macro_rules! built_in {
    ($($name:literal),* $(,)?) => {
        &[$(BuiltIn { name: $name, toml: include_str!(concat!("../../scenes/", $name, ".toml")) }),*]
    };
}

/// All built-in scenes.
pub const BUILT_IN: &[BuiltIn] = built_in![
    "tp-1",
    "tp-2",
    "sp-1",
    "sp-2",
    "prolate",
    "retrograde",
    "tiny-violation",
    "axisymmetric-violation",
    "free",
    "through-the-pole",
];
