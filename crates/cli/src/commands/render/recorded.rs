//! Poses of a recorded game: played again by this engine, or those that the record keeps.

use teeter_game::{Record, RecordError, Replay, engine_id};
use teeter_physics::{Pose, World};
use teeter_render::StrainedPose;

use super::motion::{Motion, Run, Stepped};
use crate::warnings::Warnings;

/// Returns the motion of a record. Where another engine made it, its bits may differ, and the
/// motion follows the keyframes.
///
/// # Errors
/// When no game begins as the record says.
pub fn motion(record: &Record) -> Result<Box<dyn Motion + '_>, RecordError> {
    if record.engine != engine_id() {
        return Ok(Box::new(Kept::new(record)));
    }
    Ok(Box::new(Stepped::new(Played(Replay::new(record)?))))
}

/// Game that is played again. Its time does not begin again with a tower that is rebuilt.
struct Played<'a>(Replay<'a>);

impl Run for Played<'_> {
    fn world(&self) -> &World {
        self.0.game().world()
    }

    fn time(&self) -> f64 {
        f64::from(self.0.frame()) * self.world().params().frame
    }

    fn advance(&mut self) -> bool {
        self.0.step().is_some()
    }

    fn warnings(self) -> Warnings {
        let mut warnings = Warnings::default();
        if !self.0.is_same() {
            warnings.add("the game diverges from its record, see `teeter replay --verify`");
        }
        warnings
    }
}

/// Poses that a record keeps, one set at the start and one each second.
struct Kept {
    keyframes: Vec<Vec<StrainedPose>>,
    /// Duration of the record, s.
    seconds: f64,
    engine: String,
}

impl Kept {
    fn new(record: &Record) -> Self {
        let of = |poses: Vec<_>| {
            let pose = |(position, orientation)| StrainedPose::from(Pose { position, orientation });
            poses.into_iter().map(pose).collect::<Vec<_>>()
        };
        let start = teeter_render::poses(&record.scene);
        let keyframes = std::iter::once(start).chain(record.keyframes().map(of)).collect();
        Self { keyframes, seconds: record.seconds(), engine: record.engine.clone() }
    }
}

impl Motion for Kept {
    fn poses(&mut self, time: f64) -> Vec<StrainedPose> {
        let last = self.keyframes.len() - 1;
        // The last interval may be shorter than a second.
        let time = time.min(self.seconds);
        let index = (time as usize).min(last.saturating_sub(1));
        let (from, to) = (index as f64, ((index + 1) as f64).min(self.seconds));
        let part = if to > from { ((time - from) / (to - from)).clamp(0.0, 1.0) } else { 1.0 };
        let next = &self.keyframes[(index + 1).min(last)];
        self.keyframes[index].iter().zip(next).map(|(before, after)| before.lerp(after, part)).collect()
    }

    fn warnings(self: Box<Self>) -> Warnings {
        let mut warnings = Warnings::default();
        warnings.add_engine(&self.engine, "drawn between the poses of each second");
        warnings
    }
}

#[cfg(test)]
mod tests {
    use teeter_game::{Command, Recorder, Rules};
    use teeter_physics::Params;
    use teeter_scene::named;

    use super::*;

    /// A block that falls from a metre, for a second and a quarter.
    fn fall() -> Record {
        let mut scene = named("block").unwrap();
        scene.blocks[0].pos[2] = 1.0;
        let mut recorder = Recorder::new(&scene, Params::default(), Rules::default()).unwrap();
        for _ in 0..75 {
            recorder.step(&Command::Idle).unwrap();
        }
        recorder.finish()
    }

    #[test]
    fn a_record_of_this_engine_is_played_again_and_another_follows_its_keyframes() {
        let mut record = fall();
        let height = |record: &Record, time: f64| motion(record).unwrap().poses(time)[0].pose.position.z;
        let warnings = |record: &Record| {
            let warnings = motion(record).unwrap().warnings();
            serde_json::to_value(warnings).unwrap().as_array().unwrap().len()
        };
        let fallen = 1.0 - height(&record, 0.3);
        assert!((fallen / (0.5 * 9.81 * 0.09) - 1.0).abs() < 0.02, "{fallen} m");
        let landed = height(&record, 1.25);
        assert_eq!(warnings(&record), 0);
        record.engine = "0.0.0+0123456789abcdef".into();
        // It lies on the floor after a second: between start and keyframe it is drawn in between.
        assert!((height(&record, 0.5) - 0.5 * (1.0 + height(&record, 1.0))).abs() < 1e-9);
        assert!((height(&record, 1.25) - landed).abs() < 1e-4 && height(&record, 9.0) == height(&record, 1.25));
        assert_eq!(height(&record, 0.0), 1.0);
        assert_eq!(warnings(&record), 1);
    }
}
