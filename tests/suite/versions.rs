//! The manifest, the citation and the change log have the same version.

use std::fs::read_to_string;

const VERSION: &str = env!("CARGO_PKG_VERSION");

fn file(name: &str) -> String {
    read_to_string(format!("{}/{name}", env!("CARGO_MANIFEST_DIR"))).unwrap_or_else(|error| panic!("{name}: {error}"))
}

#[test]
fn the_citation_and_the_manifest_agree() {
    let citation = file("CITATION.cff");
    let cited = citation.lines().find_map(|line| line.strip_prefix("version: "));
    assert_eq!(cited, Some(VERSION));
    let manifest = file("Cargo.toml");
    let of_packages = manifest.lines().filter(|line| line.starts_with("twofold") && line.contains("version = "));
    let versions: Vec<_> =
        of_packages.map(|line| line.split("version = \"").nth(1).and_then(|rest| rest.split('"').next())).collect();
    assert_eq!(versions, [Some(VERSION); 2]);
}

#[test]
fn the_change_log_ends_with_no_later_version() {
    let log = file("CHANGELOG.md");
    let mut headings = log.lines().filter_map(|line| line.strip_prefix("## ["));
    assert_eq!(headings.next(), Some("Unreleased]"));
    if let Some(latest) = headings.next() {
        assert_eq!(latest.split(']').next(), Some(VERSION));
    }
}
