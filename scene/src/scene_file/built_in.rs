//! Scenes included with the command: the paper's four examples, six other kinds of motion, pulsars, and templates.

/// A scene included in the program.
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

/// The scenes of the paper, and others in its units.
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

/// Pulsars, over decades.
pub const PULSARS: &[BuiltIn] = built_in!["b1937+21", "j1744-1134", "b1828-11", "b1642-03"];

/// Stars described as by an astronomer, as a starting point.
pub const TEMPLATES: &[BuiltIn] = built_in!["isolated-pulsar", "millisecond-pulsar", "wave-source"];

/// The built-in scene with a name.
pub fn built_in(name: &str) -> Option<&'static BuiltIn> {
    all().find(|scene| scene.name == name)
}

/// The names of all built-in scenes.
pub fn names() -> Vec<&'static str> {
    all().map(|scene| scene.name).collect()
}

fn all() -> impl Iterator<Item = &'static BuiltIn> {
    BUILT_IN.iter().chain(PULSARS).chain(TEMPLATES)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pulsars_and_templates_are_among_the_names() {
        let names = names();
        assert!(["tp-1", "b1937+21", "isolated-pulsar"].iter().all(|name| names.contains(name)), "{names:?}");
        assert!(names.iter().all(|name| built_in(name).is_some_and(|scene| scene.name == *name)));
    }
}
