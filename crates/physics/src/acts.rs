//! What acts on the bodies of one cluster from outside during a frame.

use glam::DVec3;

use crate::body::{Bodies, Shapes};
use crate::body_id::BodyId;
use crate::drive::Servo;
use crate::hand::{Aim, Pull};
use crate::input::{AppliedForce, Drive, Hand, Input};
use crate::kernel::Actors;
use crate::regroup::Clusters;

/// What acts on the bodies of one cluster during a frame; indices are those of the cluster.
#[derive(Debug, Clone, Default)]
pub struct Acts {
    /// The hand, and where it wanted its body before; absent for a hand that has just taken hold.
    pub hand: Option<(Hand, Option<Aim>)>,
    /// Forces, and what they were before, N.
    pub forces: Vec<(AppliedForce, DVec3)>,
    /// Drives.
    pub drives: Vec<Drive>,
}

impl Acts {
    /// Those of an input on each cluster; `aim` and `before` are hand and forces of the last frame.
    pub fn of(input: &Input, aim: Option<Aim>, before: &[AppliedForce], clusters: &Clusters) -> Vec<Self> {
        let mut acts = vec![Self::default(); clusters.list.len()];
        let place = |body: BodyId| clusters.place[body.index()];
        if let Some(hand) = &input.hand {
            let (c, i) = place(hand.body);
            let from = aim.filter(|aim| BodyId(aim.body) == hand.body).map(|aim| Aim { body: i, ..aim });
            acts[c as usize].hand = Some((Hand { body: BodyId(i), ..hand.clone() }, from));
        }
        for force in &input.forces {
            let (c, i) = place(force.body);
            let last =
                before.iter().find(|f| f.body == force.body && f.point == force.point).map_or(DVec3::ZERO, |f| f.force);
            acts[c as usize].forces.push((AppliedForce { body: BodyId(i), ..*force }, last));
        }
        for drive in &input.drives {
            let (c, i) = place(drive.body);
            acts[c as usize].drives.push(Drive { body: BodyId(i), ..*drive });
        }
        acts
    }

    /// The bodies acted on.
    pub fn bodies(&self) -> impl Iterator<Item = usize> {
        let hand = self.hand.iter().map(|(hand, _)| hand.body);
        let all = hand.chain(self.forces.iter().map(|(f, _)| f.body)).chain(self.drives.iter().map(|d| d.body));
        all.map(BodyId::index)
    }

    /// Force (N) and torque (N m) of the applied forces on body `i` when the share `share` of the frame is over.
    pub fn force(&self, bodies: &Bodies, i: usize, share: f64) -> (DVec3, DVec3) {
        let mut sum = (DVec3::ZERO, DVec3::ZERO);
        for (applied, before) in self.forces.iter().filter(|(f, _)| f.body.index() == i) {
            let force = *before + (applied.force - *before) * share;
            sum.0 += force;
            sum.1 += (bodies.orientation[i] * applied.point).cross(force);
        }
        sum
    }

    /// Hand and drives for a batch that starts when the share `done` of a frame of `frame` (s) is over.
    pub fn actors(&mut self, done: f64, frame: f64, gravity: DVec3, shapes: &Shapes, bodies: &Bodies) -> Actors {
        let hand = self.hand.as_mut().map(|(hand, from)| {
            let from = from.get_or_insert_with(|| Aim::of_grasp(hand, bodies));
            Pull::new(hand, from, done, frame, gravity, shapes, bodies)
        });
        Actors { hand, drives: self.drives.iter().map(|d| Servo::new(d, shapes, bodies)).collect() }
    }
}

/// How fast an input may move a body, m/s, whatever that does now: the speed that it wants, or that its force gives in a frame.
pub fn push(input: &Input, aim: Option<&Aim>, frame: f64, mass: impl Fn(BodyId) -> f64) -> Vec<(BodyId, f64)> {
    let drives = input.drives.iter().map(|d| (d.body, d.velocity.length()));
    let forces = input.forces.iter().map(|f| (f.body, f.force.length() / mass(f.body) * frame));
    let hand = input.hand.iter().map(|hand| {
        let way =
            aim.filter(|aim| BodyId(aim.body) == hand.body).map_or(0.0, |aim| (hand.target - aim.target).length());
        (hand.body, way / frame + hand.max_force / mass(hand.body) * frame)
    });
    drives.chain(forces).chain(hand).collect()
}
