//! Poses over time: the seam between pictures and their source.

use teeter_physics::{Params, World};
use teeter_render::{StrainedPose, poses};
use teeter_scene::Scene;
use teeter_study::Timeline;

use crate::error::Error;
use crate::warnings::Warnings;
use crate::world;

/// Source of the poses of a film: whatever moves the blocks of a scene.
pub trait Motion {
    /// Returns the poses of all blocks, in the order of the scene, at a time, s. The times of
    /// consecutive calls do not decrease.
    fn poses(&mut self, time: f64) -> Vec<StrainedPose>;

    /// Returns the warnings of the motion, at its end.
    fn warnings(self: Box<Self>) -> Warnings;
}

/// Scene as it stands.
pub struct Still {
    poses: Vec<StrainedPose>,
    warnings: Warnings,
}

impl Still {
    /// Returns a scene without motion. `timeline` has no effect on it, which is a warning.
    pub fn new(scene: &Scene, timeline: &Timeline) -> Self {
        let mut warnings = Warnings::default();
        warnings.add_pending(timeline);
        Self { poses: poses(scene), warnings }
    }
}

impl Motion for Still {
    fn poses(&mut self, _time: f64) -> Vec<StrainedPose> {
        self.poses.clone()
    }

    fn warnings(self: Box<Self>) -> Warnings {
        self.warnings
    }
}

/// Run of a world, a frame at a time.
pub trait Run {
    /// World after the frames so far.
    fn world(&self) -> &World;

    /// Time after the frames so far, s.
    fn time(&self) -> f64;

    /// Advances by a frame; false after the last.
    fn advance(&mut self) -> bool;

    /// Returns the warnings of the run, at its end.
    fn warnings(self) -> Warnings;
}

/// Motion of a run, linear within its frames.
pub struct Stepped<R> {
    run: R,
    /// Poses before the last frame.
    before: Vec<StrainedPose>,
}

impl<R: Run> Stepped<R> {
    /// Motion of a run that has not begun.
    pub fn new(run: R) -> Self {
        Self { before: poses_of(run.world()), run }
    }
}

impl<R: Run> Motion for Stepped<R> {
    fn poses(&mut self, time: f64) -> Vec<StrainedPose> {
        // The time of a world is a sum of frames.
        while self.run.time() + 1e-9 < time {
            self.before = poses_of(self.run.world());
            if !self.run.advance() {
                break;
            }
        }
        let after = poses_of(self.run.world());
        let part = (1.0 - (self.run.time() - time) / self.run.world().params().frame).clamp(0.0, 1.0);
        self.before.iter().zip(&after).map(|(before, after)| before.lerp(after, part)).collect()
    }

    fn warnings(self: Box<Self>) -> Warnings {
        self.run.warnings()
    }
}

/// Simulated scene.
pub struct Simulated<'a> {
    scene: &'a Scene,
    world: World,
    timeline: Timeline,
    warnings: Warnings,
}

impl<'a> Simulated<'a> {
    /// Builds a world from a scene.
    pub fn new(scene: &'a Scene, params: Params, timeline: Timeline) -> Result<Self, Error> {
        let world = world::build(scene, params)?;
        let mut warnings = Warnings::default();
        warnings.add_all_of(&world);
        Ok(Self { scene, world, timeline, warnings })
    }
}

impl Run for Simulated<'_> {
    fn world(&self) -> &World {
        &self.world
    }

    fn time(&self) -> f64 {
        self.world.time()
    }

    fn advance(&mut self) -> bool {
        let input = self.timeline.input(&self.world);
        let step = self.world.step(input);
        self.warnings.add_quarantined(self.scene, &step);
        true
    }

    fn warnings(mut self) -> Warnings {
        self.warnings.add_pending(&self.timeline);
        self.warnings
    }
}

fn poses_of(world: &World) -> Vec<StrainedPose> {
    world.bodies().map(|body| StrainedPose::of(world, body)).collect()
}

#[cfg(test)]
mod tests {
    use teeter_scene::named;

    use super::*;

    /// A block that falls freely: between two frames its height is between those of the frames.
    #[test]
    fn poses_between_frames_lie_between_those_of_the_frames() {
        let mut scene = named("block").unwrap();
        scene.blocks[0].pos[2] = 1.0;
        let heights = |times: &[f64]| -> Vec<f64> {
            let run = Simulated::new(&scene, Params::default(), Timeline::default()).unwrap();
            let mut motion = Stepped::new(run);
            times.iter().map(|&time| motion.poses(time)[0].pose.position.z).collect()
        };
        let frame = Params::default().frame;
        let frames = heights(&[10.0 * frame, 11.0 * frame]);
        let halves = heights(&[10.0 * frame, 10.5 * frame, 11.0 * frame]);
        assert_eq!((frames[0], frames[1]), (halves[0], halves[2]));
        assert!((halves[1] - 0.5 * (frames[0] + frames[1])).abs() < 1e-12);
        // Half of g t² within the error of the first frame.
        assert!((1.0 - frames[0] - 0.5 * 9.81 * (10.0 * frame) * (10.0 * frame)).abs() < 0.02);
    }

    #[test]
    fn a_still_stays_as_the_scene_stands() {
        let scene = named("tower").unwrap();
        let mut still = Still::new(&scene, &Timeline::default());
        assert_eq!(still.poses(3.0), poses(&scene));
    }
}
