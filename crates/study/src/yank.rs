//! Rough play: a block torn out of a tower, and what becomes of the heap.

use glam::DVec3;
use serde::Serialize;
use teeter_physics::{BodyId, Drive, Input, World};

use crate::settle::frames;
use crate::solid::{Solid, deepest, deepest_between};

/// How far a block is torn, m.
const TORN: f64 = 0.12;
/// An overlap of more than this is one, m.
const OVERLAP: f64 = 1e-3;
/// An overlap of more than this on the straight way between two looks says that a block went through another, m: a third of the thinnest block.
const THROUGH: f64 = 5e-3;
/// Speed below which a heap is quiet, m/s.
const QUIET: f64 = 5e-3;

/// How it went.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
pub struct Yank {
    /// Deepest overlap of two blocks, or of one and the floor, at the end of any frame, mm.
    pub deepest_mm: f64,
    /// Longest time for which some overlap was more than 1 mm, s.
    pub lasting_s: f64,
    /// Whether a block went through another between two frames.
    pub through: bool,
    /// Whether a number was not finite, or a block ran away and was frozen.
    pub lost: bool,
    /// Fastest block at the end, m/s.
    pub speed_at_end: f64,
    /// Since when nothing moved faster than 5 mm/s, s after the block was let go; none where something does at the end.
    pub quiet_s: Option<f64>,
    /// Blocks that moved by more than 20 mm.
    pub moved: usize,
}

/// Tears `bodies` out of a settled world with a velocity (m/s), lets go, and watches for `seconds`. What is seen is what is at the ends of frames and
/// on the straight way between them: frames should be short, 1/240 s.
pub fn yank(settled: &World, bodies: &[BodyId], velocity: DVec3, seconds: f64) -> Yank {
    let mut world = settled.clone();
    let frame = world.params().frame;
    let tearing = (TORN / velocity.length() / frame).ceil() as usize;
    let drives = bodies.iter().map(|&body| Drive::new(body, velocity)).collect();
    let tear = Input::drives(drives);
    let free = Input::default();
    let mut seen = Yank::default();
    let start = Solid::all(&world);
    let (mut before, mut lasting) = (start.clone(), 0.0);
    for i in 0..tearing + frames(&world, seconds) {
        let report = world.step(if i < tearing { &tear } else { &free });
        let now = Solid::all(&world);
        seen.lost |= !report.quarantined.is_empty() || world.poses().iter().any(|x| !x.is_finite());
        let depth = deepest(&now);
        seen.deepest_mm = seen.deepest_mm.max(1e3 * depth);
        lasting = if depth > OVERLAP { lasting + frame } else { 0.0 };
        seen.lasting_s = seen.lasting_s.max(lasting);
        seen.through |= deepest_between(&before, &now) > THROUGH;
        before = now;
        seen.speed_at_end = report.max_speed;
        let since = (i + 1).saturating_sub(tearing) as f64 * frame;
        seen.quiet_s = if report.max_speed < QUIET { seen.quiet_s.or(Some(since)) } else { None };
    }
    seen.moved = start.iter().zip(&before).filter(|(a, b)| a.center.distance(b.center) > 0.02).count();
    seen
}
