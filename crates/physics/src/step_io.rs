//! Input and report of a step.

use glam::DVec3;

use crate::actuator::hand::{HandTarget, grasp_point};
use crate::actuator::limits::{self, shortened};
use crate::body_id::BodyId;
use crate::cluster::frame::ClusterReport;
use crate::constants::{MAX_ANCHOR, MAX_GRAVITY, MAX_INPUT_DISTANCE, MAX_INPUT_SPEED};
use crate::input::{Grip, Hand, Input};
use crate::report::StepReport;
use crate::world::World;

impl World {
    /// Returns the input without its invalid parts: unknown or quarantined bodies, numbers that are
    /// not finite, negative limits. What exceeds the limits of [`Input`] is reduced to them.
    pub(crate) fn sanitise(&self, input: &Input) -> Input {
        let known = |body: BodyId| body.index() < self.len();
        let mut input = input.clone();
        input.gravity = input.gravity.filter(|g| g.is_finite()).map(|g| shortened(g, MAX_GRAVITY));
        input.forces.retain(|f| known(f.body) && f.point.is_finite() && f.force.is_finite());
        input.drives.retain(|d| known(d.body) && d.velocity.is_finite() && d.max_force >= 0.0);
        input.hand = input.hand.filter(|h| known(h.body) && !self.is_immovable(h.body) && is_valid(h));
        for force in &mut input.forces {
            let (cluster, i) = self.clusters.get(force.body.0);
            force.point = shortened(force.point, MAX_INPUT_DISTANCE);
            force.force = shortened(force.force, limits::max_force(&cluster.shapes, i));
        }
        for drive in &mut input.drives {
            drive.velocity = shortened(drive.velocity, MAX_INPUT_SPEED);
        }
        if let Some(hand) = &mut input.hand {
            self.limit_hand(hand);
        }
        input
    }

    /// Reduces what exceeds the limits of a hand.
    fn limit_hand(&self, hand: &mut Hand) {
        let (cluster, i) = self.clusters.get(hand.body.0);
        let radius = cluster.shapes.radius[i];
        hand.anchor = shortened(hand.anchor, MAX_ANCHOR * radius);
        hand.target = shortened(hand.target, MAX_INPUT_DISTANCE);
        hand.max_force = hand.max_force.min(Hand::MAX_FORCE);
        hand.max_torque = hand.max_torque.min(Hand::MAX_FORCE * radius);
        hand.orientation = hand.orientation.and_then(limits::unit);
        if let Grip::Push { axis } = &mut hand.grip {
            // The square of a longer vector may overflow.
            let direction = if axis.length_squared().is_finite() { *axis } else { shortened(*axis, 1.0) };
            *axis = direction.normalize_or_zero();
        }
    }

    /// Wakes the bodies that the input acts on, and those that the last one acted on: a hand or
    /// force that lets go changes loads as well.
    ///
    /// Returns the energy that a change of gravity adds to the bodies, J.
    pub(crate) fn wake_targets(&mut self, input: &Input) -> f64 {
        let gravity = input.gravity.unwrap_or(self.derived.scene_gravity());
        let mut targets: Vec<BodyId> = input.forces.iter().map(|f| f.body).collect();
        targets.extend(input.drives.iter().map(|d| d.body));
        targets.extend(input.hand.iter().map(|h| h.body));
        targets.extend(self.forces.iter().map(|f| f.body));
        targets.extend(self.hand_target.iter().map(|target| target.body));
        if gravity != self.gravity {
            targets = self.bodies().collect();
        }
        let change = std::mem::replace(&mut self.gravity, gravity) - gravity;
        targets.into_iter().for_each(|body| self.wake(body));
        if change == DVec3::ZERO {
            return 0.0;
        }
        let movable = self.bodies().filter(|&body| !self.is_immovable(body));
        movable.map(|body| self.mass(body) * change.dot(self.pose(body).position)).sum()
    }

    /// Stores the parts of the input that the next step ramps from.
    pub(crate) fn store_input(&mut self, input: &Input) {
        self.hand_target = input.hand.as_ref().map(HandTarget::at_end);
        self.forces.clone_from(&input.forces);
    }

    /// Updates time and poses at the end of a step and returns the report on it.
    ///
    /// `put_in` is the energy that was put in before the clusters were stepped, J.
    pub(crate) fn report(&mut self, input: &Input, clusters: Vec<ClusterReport>, put_in: f64) -> StepReport {
        self.time += self.derived.substeps as f64 * self.derived.h;
        self.write_poses();
        let mut report = StepReport { time: self.time, put_in, ..StepReport::default() };
        let mut squares = 0.0;
        for (cluster, part) in self.clusters.list.iter().zip(clusters) {
            report.substeps = report.substeps.max(part.substeps);
            report.syncs += part.syncs;
            report.detections += part.detections;
            report.manifolds += cluster.contacts.manifolds.len() as u32;
            let points = cluster.contacts.manifolds.iter().flat_map(|m| &m.points);
            report.touching += points.filter(|p| p.normal_force > 0.0).count() as u32;
            report.awake += (0..cluster.len()).filter(|&i| cluster.bodies.is_active(i)).count() as u32;
            report.penetration = report.penetration.max(part.penetration);
            // The forces on a body that is frozen may be no numbers.
            report.put_in += if part.work.is_finite() { part.work } else { 0.0 };
            for v in &cluster.bodies.velocity {
                squares += v.length_squared();
                report.max_speed = report.max_speed.max(v.length());
            }
            report.quarantined.extend(part.quarantined.iter().map(|&i| BodyId(cluster.ids[i as usize])));
            report.hand = report.hand.or(part.hand);
        }
        report.quarantined.sort_unstable();
        report.rms_speed = (squares / self.len().max(1) as f64).sqrt();
        if let (Some(to), Some(hand)) = (&mut report.hand, &input.hand) {
            let (cluster, i) = self.clusters.get(hand.body.0);
            to.point = grasp_point(&hand.anchor, &cluster.bodies, i);
        }
        report
    }
}

/// Returns true if every number of a hand is finite and its limits are not negative.
fn is_valid(hand: &Hand) -> bool {
    let axis_is_finite = match hand.grip {
        Grip::Push { axis } => axis.is_finite(),
        Grip::Slide | Grip::Carry => true,
    };
    axis_is_finite
        && hand.anchor.is_finite()
        && hand.target.is_finite()
        && hand.orientation.is_none_or(|q| limits::unit(q).is_some())
        && hand.max_force >= 0.0
        && hand.max_torque >= 0.0
}
