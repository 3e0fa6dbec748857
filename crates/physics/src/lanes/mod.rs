//! Eight numbers at once, for the widths that machines have.
//!
//! Every operation rounds each lane as the plain number does, and none mixes lanes but [`Lanes::transpose`], which rounds nothing:
//! all implementations give the same bits. There is deliberately no fused multiply-add, no reciprocal estimate and no sum across.

use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

#[cfg(target_arch = "x86_64")]
pub mod avx2;
pub mod float_mode;
pub mod portable;
#[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
pub mod simd128;
#[cfg(target_arch = "x86_64")]
pub mod sse2;
#[cfg(test)]
mod tests;

/// Numbers in a bundle.
pub const LANES: usize = 8;

/// f32 or f64, with just the operations that round the same on every target.
pub trait Real:
    Copy
    + Default
    + PartialOrd
    + std::fmt::Debug
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + Send
    + Sync
    + 'static
{
    /// Eight of them with AVX2.
    #[cfg(target_arch = "x86_64")]
    type Avx2: Lanes<Number = Self>;
    /// Eight of them with the instructions that are always there.
    type Base: Lanes<Number = Self>;
    /// The nearest value.
    fn from_f64(x: f64) -> Self;
    /// The same value.
    fn to_f64(self) -> f64;
    /// Square root, correctly rounded.
    fn sqrt(self) -> Self;
}

macro_rules! real {
    ($t:ty, $avx2:ty, $sse2:ty, $simd128:ty) => {
        impl Real for $t {
            #[cfg(target_arch = "x86_64")]
            type Avx2 = $avx2;
            #[cfg(target_arch = "x86_64")]
            type Base = $sse2;
            #[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
            type Base = $simd128;
            #[cfg(not(any(target_arch = "x86_64", all(target_arch = "wasm32", target_feature = "simd128"))))]
            type Base = portable::Wide<$t>;
            #[inline(always)]
            fn from_f64(x: f64) -> Self {
                x as $t
            }
            #[inline(always)]
            fn to_f64(self) -> f64 {
                f64::from(self)
            }
            #[inline(always)]
            fn sqrt(self) -> Self {
                <$t>::sqrt(self)
            }
        }
    };
}
real!(f32, avx2::F32, sse2::F32, simd128::F32);
real!(f64, avx2::F64, sse2::F64, simd128::F64);

/// Eight numbers, one a lane.
pub trait Lanes:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self> + Neg<Output = Self> + AddAssign + SubAssign
{
    /// What a lane holds.
    type Number: Real;
    /// A yes or no a lane.
    type Mask: Copy;
    /// The same number in all lanes.
    fn splat(x: Self::Number) -> Self;
    /// From memory.
    fn load(from: &[Self::Number; LANES]) -> Self;
    /// To memory.
    fn store(self, to: &mut [Self::Number; LANES]);
    /// Square roots.
    fn sqrt(self) -> Self;
    /// Where self < other; never where one is not a number.
    fn less(self, other: Self) -> Self::Mask;
    /// `yes` where the mask holds, `no` elsewhere.
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self;
    /// Whether the mask holds anywhere.
    fn any(mask: Self::Mask) -> bool;
    /// Where both masks hold.
    fn both(a: Self::Mask, b: Self::Mask) -> Self::Mask;
    /// Lane j of bundle i becomes lane i of bundle j.
    fn transpose(rows: [Self; 8]) -> [Self; 8];

    /// The number in all lanes, from f64.
    #[inline(always)]
    fn number(x: f64) -> Self {
        Self::splat(Self::Number::from_f64(x))
    }
    /// Zeros.
    #[inline(always)]
    fn zero() -> Self {
        Self::number(0.0)
    }
}

/// Transposes eight bundles of two registers: four blocks of 4 x 4, of which the off-diagonal two change places.
#[inline(always)]
pub(crate) fn in_quarters<T: Copy>(rows: [[T; 2]; 8], quarter: impl Fn([T; 4]) -> [T; 4]) -> [[T; 2]; 8] {
    let block = |first: usize, half: usize| quarter([0, 1, 2, 3].map(|i| rows[first + i][half]));
    let (p, q, r, s) = (block(0, 0), block(0, 1), block(4, 0), block(4, 1));
    std::array::from_fn(|i| if i < 4 { [p[i], r[i]] } else { [q[i - 4], s[i - 4]] })
}

/// The operators of a bundle that is made of several registers, each done part by part.
macro_rules! operators {
    ($t:ident $(<$r:ident>)?, |$a:ident, $b:ident| $add:expr, $sub:expr, $mul:expr, $div:expr, |$c:ident| $neg:expr) => {
        impl $(<$r: $crate::lanes::Real>)? std::ops::Add for $t $(<$r>)? {
            type Output = Self;
            #[inline(always)]
            fn add(self, o: Self) -> Self {
                Self(std::array::from_fn(|i| { let ($a, $b) = (self.0[i], o.0[i]); $add }))
            }
        }
        impl $(<$r: $crate::lanes::Real>)? std::ops::Sub for $t $(<$r>)? {
            type Output = Self;
            #[inline(always)]
            fn sub(self, o: Self) -> Self {
                Self(std::array::from_fn(|i| { let ($a, $b) = (self.0[i], o.0[i]); $sub }))
            }
        }
        impl $(<$r: $crate::lanes::Real>)? std::ops::Mul for $t $(<$r>)? {
            type Output = Self;
            #[inline(always)]
            fn mul(self, o: Self) -> Self {
                Self(std::array::from_fn(|i| { let ($a, $b) = (self.0[i], o.0[i]); $mul }))
            }
        }
        impl $(<$r: $crate::lanes::Real>)? std::ops::Div for $t $(<$r>)? {
            type Output = Self;
            #[inline(always)]
            fn div(self, o: Self) -> Self {
                Self(std::array::from_fn(|i| { let ($a, $b) = (self.0[i], o.0[i]); $div }))
            }
        }
        impl $(<$r: $crate::lanes::Real>)? std::ops::Neg for $t $(<$r>)? {
            type Output = Self;
            #[inline(always)]
            fn neg(self) -> Self {
                Self(std::array::from_fn(|i| { let $c = self.0[i]; $neg }))
            }
        }
        impl $(<$r: $crate::lanes::Real>)? std::ops::AddAssign for $t $(<$r>)? {
            #[inline(always)]
            fn add_assign(&mut self, o: Self) {
                *self = *self + o;
            }
        }
        impl $(<$r: $crate::lanes::Real>)? std::ops::SubAssign for $t $(<$r>)? {
            #[inline(always)]
            fn sub_assign(&mut self, o: Self) {
                *self = *self - o;
            }
        }
    };
}
pub(crate) use operators;
