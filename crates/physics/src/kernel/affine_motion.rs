//! Relative motion of two affine bodies at a contact, and the wrench dual to it.

use crate::kernel::body_model::RelativeMotion;
use crate::simd::lanes::Lanes;

/// Relative velocity at the centroid and its gradient along each tangent, in components along
/// normal, tangent, tangent.
#[derive(Debug, Clone, Copy)]
pub struct AffineMotion<L> {
    pub v: [L; 3],
    pub gradient: [[L; 3]; 2],
}

/// Force, and moment of the force along each tangent (force times offset), in components along
/// normal, tangent, tangent.
#[derive(Debug, Clone, Copy)]
pub struct AffineWrench<L> {
    pub f: [L; 3],
    pub moments: [[L; 3]; 2],
}

impl<L: Lanes> RelativeMotion<L> for AffineMotion<L> {
    type Wrench = AffineWrench<L>;

    #[inline(always)]
    fn zero() -> Self {
        Self { v: [L::zero(); 3], gradient: [[L::zero(); 3]; 2] }
    }

    #[inline(always)]
    fn zero_wrench() -> AffineWrench<L> {
        AffineWrench { f: [L::zero(); 3], moments: [[L::zero(); 3]; 2] }
    }

    #[inline(always)]
    fn normal_velocity(&self) -> L {
        self.v[0]
    }

    #[inline(always)]
    fn velocity_at(&self, r: &[L; 2], q: &[L; 3]) -> [L; 4] {
        let [x, y] = &self.gradient;
        let spin = (x[2] - y[1]) * L::splat_f64(0.5);
        [
            self.v[0] + (x[0] * r[0] + y[0] * r[1]),
            self.v[1] + (x[1] * q[0] + y[1] * q[1]),
            self.v[2] + (x[2] * q[0] + y[2] * q[1]),
            spin * q[2],
        ]
    }

    #[inline(always)]
    fn add_force<const FIRST: bool>(wrench: &mut AffineWrench<L>, force: &[L; 4], r: &[L; 2], q: &[L; 3]) {
        let turning = q[2] * force[3] * L::splat_f64(0.5);
        let moment = |k: usize| [r[k] * force[0], q[k] * force[1], q[k] * force[2]];
        if FIRST {
            *wrench = AffineWrench { f: [force[0], force[1], force[2]], moments: [moment(0), moment(1)] };
        } else {
            wrench.f[0] += force[0];
            wrench.f[1] += force[1];
            wrench.f[2] += force[2];
            for (k, sum) in wrench.moments.iter_mut().enumerate() {
                let moment = moment(k);
                sum[0] += moment[0];
                sum[1] += moment[1];
                sum[2] += moment[2];
            }
        }
        wrench.moments[0][2] += turning;
        wrench.moments[1][1] -= turning;
    }
}
