//! Several numbers at once, for the widths that machines have.
//!
//! Every operation rounds each lane as the plain number does, and none mixes lanes but the two of [`Turn`], which round nothing: all
//! implementations give the same bits. There is deliberately no fused multiply-add, no reciprocal estimate and no sum across.
//!
//! A type here is one register. Data lie in lines of [`LANES`] numbers, of which a register holds a part, or all of it.

use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

#[cfg(target_arch = "x86_64")]
pub mod avx2;
#[cfg(target_arch = "x86_64")]
pub mod avx512;
pub mod float_mode;
pub mod portable;
#[cfg(any(target_arch = "x86_64", all(target_arch = "wasm32", target_feature = "simd128")))]
mod register;
#[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
pub mod simd128;
#[cfg(target_arch = "x86_64")]
pub mod sse2;
#[cfg(test)]
mod tests;

/// Numbers in a line of data: as many as the widest register holds that the target may have. The order of sums does not depend on it.
pub const LANES: usize = if cfg!(target_arch = "x86_64") {
    16
} else if cfg!(all(target_arch = "wasm32", target_feature = "simd128")) {
    4
} else {
    1
};
/// Numbers in a row.
pub const ROW: usize = 8;

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
    /// A register of AVX-512, or the widest that is of use there.
    #[cfg(target_arch = "x86_64")]
    type Avx512: Lanes<Number = Self>;
    /// A register of AVX2.
    #[cfg(target_arch = "x86_64")]
    type Avx2: Lanes<Number = Self>;
    /// A register that is always there.
    type Base: Lanes<Number = Self>;
    /// Most that rounding changes a number, over the number.
    const HALF_ULP: f64;
    /// The nearest value.
    fn from_f64(x: f64) -> Self;
    /// The same value.
    fn to_f64(self) -> f64;
    /// Square root, correctly rounded.
    fn sqrt(self) -> Self;
}

macro_rules! real {
    ($t:ty, $avx512:ty, $avx2:ty, $sse2:ty, $simd128:ty) => {
        impl Real for $t {
            #[cfg(target_arch = "x86_64")]
            type Avx512 = $avx512;
            #[cfg(target_arch = "x86_64")]
            type Avx2 = $avx2;
            #[cfg(target_arch = "x86_64")]
            type Base = $sse2;
            #[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
            type Base = $simd128;
            #[cfg(not(any(target_arch = "x86_64", all(target_arch = "wasm32", target_feature = "simd128"))))]
            type Base = portable::Plain<$t>;
            const HALF_ULP: f64 = 0.5 * <$t>::EPSILON as f64;
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
real!(f32, avx512::F32, avx2::F32, sse2::F32, simd128::F32);
real!(f64, avx2::F64, avx2::F64, sse2::F64, simd128::F64);

/// Several numbers, one a lane.
pub trait Lanes:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + AddAssign
    + SubAssign
    + Turn
{
    /// A yes or no a lane.
    type Mask: Copy;
    /// Number of lanes; divides [`LANES`].
    const WIDTH: usize;
    /// The same number in all lanes.
    fn splat(x: Self::Number) -> Self;
    /// The part of a line that begins at [`Lanes::WIDTH`] * `part`.
    ///
    /// # Panics
    /// Where the line has no such part.
    fn load<const N: usize>(from: &[Self::Number; N], part: usize) -> Self;
    /// To such a part.
    ///
    /// # Panics
    /// As [`Lanes::load`].
    fn store<const N: usize>(self, to: &mut [Self::Number; N], part: usize);
    /// Square roots.
    fn sqrt(self) -> Self;
    /// Where self < other; never where one is not a number.
    fn less(self, other: Self) -> Self::Mask;
    /// `yes` where the mask holds, `no` elsewhere.
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self;
    /// `x` where the mask holds, zero elsewhere.
    fn only(mask: Self::Mask, x: Self) -> Self;
    /// Whether the mask holds anywhere.
    fn any(mask: Self::Mask) -> bool;

    /// The first lane.
    #[inline(always)]
    fn first(self) -> Self::Number {
        let mut x = [Self::Number::default(); LANES];
        self.store(&mut x, 0);
        x[0]
    }

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

/// Between rows, each with the [`ROW`] numbers of one thing, of which the fourth and the eighth are zero, and columns, each with one number of as many things as there are lanes.
pub trait Turn: Sized {
    /// What a lane holds.
    type Number: Real;
    /// A row in registers.
    type Row: Row<Self::Number>;
    /// As many as there are lanes.
    type Rows: IntoIterator<Item = Self::Row>;
    /// Lane l of column i is number i of row l.
    fn columns(row: impl FnMut(usize) -> Self::Row) -> [Self; ROW];
    /// The other way round: the rows in the order of the lanes.
    fn rows(columns: [Self; ROW]) -> Self::Rows;
}

/// A row that can be read and written.
pub trait Row<R>: Copy + Add<Output = Self> + Sub<Output = Self> {
    /// From memory.
    fn read(from: &[R; ROW]) -> Self;
    /// To memory.
    fn write(self, to: &mut [R; ROW]);
}
