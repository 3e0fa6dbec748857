//! Poses over time: the seam between pictures and their source.

use teeter_physics::{Params, World};
use teeter_render::{StrainedPose, poses};
use teeter_scene::Scene;
use teeter_study::Timeline;

use crate::error::Error;
use crate::warnings::Warnings;

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

/// Simulated scene.
pub struct Simulated<'a> {
    scene: &'a Scene,
    world: World,
    timeline: Timeline,
    warnings: Warnings,
    /// State before the last step, whose duration is `frame`, s.
    before: Vec<StrainedPose>,
    frame: f64,
}

impl<'a> Simulated<'a> {
    /// Builds a world from a scene.
    pub fn new(scene: &'a Scene, params: Params, timeline: Timeline) -> Result<Self, Error> {
        let world = World::new(scene, params).map_err(|source| Error::Build { name: scene.name.clone(), source })?;
        let mut warnings = Warnings::default();
        warnings.add_all_of(&world);
        let frame = world.params().frame;
        Ok(Self { before: poses_of(&world), scene, world, timeline, warnings, frame })
    }
}

impl Motion for Simulated<'_> {
    fn poses(&mut self, time: f64) -> Vec<StrainedPose> {
        // The time of a world is a sum of frames.
        while self.world.time() + 1e-9 < time {
            self.before = poses_of(&self.world);
            let input = self.timeline.input(&self.world);
            let step = self.world.step(input);
            self.warnings.add_quarantined(self.scene, &step);
        }
        let after = poses_of(&self.world);
        let part = (1.0 - (self.world.time() - time) / self.frame).clamp(0.0, 1.0);
        self.before.iter().zip(&after).map(|(before, after)| before.lerp(after, part)).collect()
    }

    fn warnings(mut self: Box<Self>) -> Warnings {
        self.warnings.add_pending(&self.timeline);
        self.warnings
    }
}

/// Poses of all bodies of a world.
pub fn poses_of(world: &World) -> Vec<StrainedPose> {
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
            let mut motion = Simulated::new(&scene, Params::default(), Timeline::default()).unwrap();
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
