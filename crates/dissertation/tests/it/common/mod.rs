//! Helpers of the tests.

use glam::DVec3;
use proptest::prelude::*;
use teeter_dissertation::jenga3d::{Constants, Jenga3D};
use teeter_scene::Scene;

/// Configuration of a property with `default` cases, which `PROPTEST_CASES` overrides.
pub fn cases(default: u32) -> ProptestConfig {
    let cases = std::env::var("PROPTEST_CASES").ok().and_then(|n| n.parse().ok()).unwrap_or(default);
    ProptestConfig { cases, failure_persistence: None, ..ProptestConfig::default() }
}

/// A vector with coordinates from -1 to 1.
pub fn vector() -> impl Strategy<Value = DVec3> {
    [-1.0..1.0, -1.0..1.0, -1.0..1.0f64].prop_map(DVec3::from)
}

/// Returns a simulator of a scene after some frames.
pub fn settled(scene: &Scene, constants: Constants, frames: u32) -> Jenga3D {
    let mut simulator = Jenga3D::new(scene, constants).unwrap();
    for _ in 0..frames {
        simulator.frame(None);
    }
    simulator
}
