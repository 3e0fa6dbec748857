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
#[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
pub mod simd128;
#[cfg(target_arch = "x86_64")]
pub mod sse2;
#[cfg(test)]
mod tests;

/// Numbers in a line of data: as many as the widest register holds.
pub const LANES: usize = 16;
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
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self> + Neg<Output = Self> + AddAssign + SubAssign + Turn
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

/// A row as so many registers.
#[derive(Debug, Clone, Copy)]
pub struct Parts<L, const N: usize>(pub [L; N]);

impl<L: Copy + Add<Output = L>, const N: usize> Add for Parts<L, N> {
    type Output = Self;
    #[inline(always)]
    fn add(self, o: Self) -> Self {
        Self(std::array::from_fn(|i| self.0[i] + o.0[i]))
    }
}

impl<L: Copy + Sub<Output = L>, const N: usize> Sub for Parts<L, N> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, o: Self) -> Self {
        Self(std::array::from_fn(|i| self.0[i] - o.0[i]))
    }
}

/// A row that can be read and written.
pub trait Row<R>: Copy + Add<Output = Self> + Sub<Output = Self> {
    /// Zeros.
    fn zero() -> Self;
    /// From memory.
    fn read(from: &[R; ROW]) -> Self;
    /// To memory.
    fn write(self, to: &mut [R; ROW]);
}

impl<L: Lanes, const N: usize> Row<L::Number> for Parts<L, N> {
    #[inline(always)]
    fn zero() -> Self {
        Self([L::zero(); N])
    }
    #[inline(always)]
    fn read(from: &[L::Number; ROW]) -> Self {
        Self(std::array::from_fn(|i| L::load(from, i)))
    }
    #[inline(always)]
    fn write(self, to: &mut [L::Number; ROW]) {
        for (i, part) in self.0.into_iter().enumerate() {
            part.store(to, i);
        }
    }
}

/// The first rows. The closure is called in one place, which lets the compiler put it there.
#[inline(always)]
pub(crate) fn collect<R, T: Row<R>, const N: usize>(mut row: impl FnMut(usize) -> T) -> [T; N] {
    let mut rows = [T::zero(); N];
    for (l, to) in rows.iter_mut().enumerate() {
        *to = row(l);
    }
    rows
}

/// [`Turn`] for a register of four lanes, from the transposition of four registers.
macro_rules! turn_fours {
    ($t:ident, $number:ty, $transposed:ident) => {
        impl $crate::lanes::Turn for $t {
            type Number = $number;
            type Row = $crate::lanes::Parts<Self, 2>;
            type Rows = [Self::Row; 4];
            #[inline(always)]
            fn columns(row: impl FnMut(usize) -> Self::Row) -> [Self; 8] {
                let [p, q, r, s]: [Self::Row; 4] = $crate::lanes::collect(row);
                let [a, b, c, d] = $transposed([p.0[0].0, q.0[0].0, r.0[0].0, s.0[0].0]);
                let [e, f, g, h] = $transposed([p.0[1].0, q.0[1].0, r.0[1].0, s.0[1].0]);
                [Self(a), Self(b), Self(c), Self(d), Self(e), Self(f), Self(g), Self(h)]
            }
            #[inline(always)]
            fn rows([a, b, c, d, e, f, g, h]: [Self; 8]) -> Self::Rows {
                let [p, q, r, s] = $transposed([a.0, b.0, c.0, d.0]);
                let [t, u, v, w] = $transposed([e.0, f.0, g.0, h.0]);
                [
                    $crate::lanes::Parts([Self(p), Self(t)]),
                    $crate::lanes::Parts([Self(q), Self(u)]),
                    $crate::lanes::Parts([Self(r), Self(v)]),
                    $crate::lanes::Parts([Self(s), Self(w)]),
                ]
            }
        }
    };
}
pub(crate) use turn_fours;

/// [`Turn`] for a register of two lanes, from the two interleavings of two registers.
macro_rules! turn_twos {
    ($t:ident, $number:ty, $low:expr, $high:expr) => {
        impl $crate::lanes::Turn for $t {
            type Number = $number;
            type Row = $crate::lanes::Parts<Self, 4>;
            type Rows = [Self::Row; 2];
            #[inline(always)]
            fn columns(row: impl FnMut(usize) -> Self::Row) -> [Self; 8] {
                let [p, q]: [Self::Row; 2] = $crate::lanes::collect(row);
                let ([a, b, c, d], [e, f, g, h]) = (p.0, q.0);
                [
                    Self($low(a.0, e.0)),
                    Self($high(a.0, e.0)),
                    Self($low(b.0, f.0)),
                    Self($high(b.0, f.0)),
                    Self($low(c.0, g.0)),
                    Self($high(c.0, g.0)),
                    Self($low(d.0, h.0)),
                    Self($high(d.0, h.0)),
                ]
            }
            #[inline(always)]
            fn rows([a, b, c, d, e, f, g, h]: [Self; 8]) -> Self::Rows {
                [
                    $crate::lanes::Parts([Self($low(a.0, b.0)), Self($low(c.0, d.0)), Self($low(e.0, f.0)), Self($low(g.0, h.0))]),
                    $crate::lanes::Parts([Self($high(a.0, b.0)), Self($high(c.0, d.0)), Self($high(e.0, f.0)), Self($high(g.0, h.0))]),
                ]
            }
        }
    };
}
pub(crate) use turn_twos;

/// A type that is one register, with [`Lanes`] from the machine's operations. Those may be unsafe because the machine might not have
/// them: who uses the type has made sure that it does.
macro_rules! register {
    (
        $(#[$doc:meta])*
        $t:ident: $width:literal x $number:ty => $register:ty, mask $mask:ty;
        $splat:expr; $load:expr; $store:expr; $sqrt:expr;
        $add:expr; $sub:expr; $mul:expr; $div:expr; $neg:expr;
        $less:expr; $select:expr; $only:expr; $any:expr
    ) => {
        $(#[$doc])*
        #[derive(Debug, Clone, Copy)]
        pub struct $t(pub(crate) $register);
        $crate::lanes::register!(@ $t, Add, add, $add);
        $crate::lanes::register!(@ $t, Sub, sub, $sub);
        $crate::lanes::register!(@ $t, Mul, mul, $mul);
        $crate::lanes::register!(@ $t, Div, div, $div);
        #[allow(unused_unsafe, reason = "in WebAssembly these operations are safe")]
        impl std::ops::Neg for $t {
            type Output = Self;
            #[inline(always)]
            fn neg(self) -> Self {
                Self(unsafe { $neg(self.0) })
            }
        }
        impl std::ops::AddAssign for $t {
            #[inline(always)]
            fn add_assign(&mut self, o: Self) {
                *self = *self + o;
            }
        }
        impl std::ops::SubAssign for $t {
            #[inline(always)]
            fn sub_assign(&mut self, o: Self) {
                *self = *self - o;
            }
        }
        #[allow(unused_unsafe, reason = "some operations are safe, such as those on masks that are numbers")]
        impl $crate::lanes::Lanes for $t {
            type Mask = $mask;
            const WIDTH: usize = $width;
            #[inline(always)]
            fn splat(x: $number) -> Self {
                Self(unsafe { $splat(x) })
            }
            #[inline(always)]
            fn load<const N: usize>(from: &[$number; N], part: usize) -> Self {
                assert!(part < N / $width);
                // SAFETY: the part lies within the line; loads need no alignment
                Self(unsafe { $load(from.as_ptr().add($width * part).cast()) })
            }
            #[inline(always)]
            fn store<const N: usize>(self, to: &mut [$number; N], part: usize) {
                assert!(part < N / $width);
                // SAFETY: as for loads
                unsafe { $store(to.as_mut_ptr().add($width * part).cast(), self.0) }
            }
            #[inline(always)]
            fn sqrt(self) -> Self {
                Self(unsafe { $sqrt(self.0) })
            }
            #[inline(always)]
            fn less(self, other: Self) -> $mask {
                unsafe { $less(self.0, other.0) }
            }
            #[inline(always)]
            fn select(mask: $mask, yes: Self, no: Self) -> Self {
                Self(unsafe { $select(mask, yes.0, no.0) })
            }
            #[inline(always)]
            fn only(mask: $mask, x: Self) -> Self {
                Self(unsafe { $only(mask, x.0) })
            }
            #[inline(always)]
            fn any(mask: $mask) -> bool {
                unsafe { $any(mask) }
            }
        }
    };
    (@ $t:ident, $trait:ident, $name:ident, $op:expr) => {
        #[allow(unused_unsafe, reason = "in WebAssembly these operations are safe")]
        impl std::ops::$trait for $t {
            type Output = Self;
            #[inline(always)]
            fn $name(self, o: Self) -> Self {
                Self(unsafe { $op(self.0, o.0) })
            }
        }
    };
}
pub(crate) use register;
