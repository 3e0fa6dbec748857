//! Helpers of the tests.
#![allow(dead_code)]

use glam::DVec3;
use proptest::prelude::*;

/// Configuration of a property with `default` cases, which `PROPTEST_CASES` overrides.
pub fn cases(default: u32) -> ProptestConfig {
    let cases = std::env::var("PROPTEST_CASES").ok().and_then(|n| n.parse().ok()).unwrap_or(default);
    ProptestConfig { cases, failure_persistence: None, ..ProptestConfig::default() }
}

/// A vector with coordinates from -1 to 1.
pub fn vector() -> impl Strategy<Value = DVec3> {
    [-1.0..1.0, -1.0..1.0, -1.0..1.0f64].prop_map(DVec3::from)
}
