//! WebAssembly registers (128 bits).

use std::arch::wasm32::*;

use super::register::{register, transpose_fours, transpose_twos};

register! {
    /// Register of four f32.
    F32: 4 x f32 => v128, mask v128;
    f32x4_splat; |p| v128_load(p); |p, x| v128_store(p, x); f32x4_sqrt;
    f32x4_add; f32x4_sub; f32x4_mul; f32x4_div; f32x4_neg; |a, b| f32x4_pmin(b, a);
    f32x4_lt; |m, yes, no| v128_bitselect(yes, no, m); v128_and; v128_any_true
}
register! {
    /// Register of two f64.
    F64: 2 x f64 => v128, mask v128;
    f64x2_splat; |p| v128_load(p); |p, x| v128_store(p, x); f64x2_sqrt;
    f64x2_add; f64x2_sub; f64x2_mul; f64x2_div; f64x2_neg; |a, b| f64x2_pmin(b, a);
    f64x2_lt; |m, yes, no| v128_bitselect(yes, no, m); v128_and; v128_any_true
}

transpose_fours!(F32, f32, transpose4);
transpose_twos!(F64, f64, |a, b| i64x2_shuffle::<0, 2>(a, b), |a, b| i64x2_shuffle::<1, 3>(a, b));

#[inline(always)]
fn transpose4([a, b, c, d]: [v128; 4]) -> [v128; 4] {
    let (ab0, ab1) = (i32x4_shuffle::<0, 4, 1, 5>(a, b), i32x4_shuffle::<2, 6, 3, 7>(a, b));
    let (cd0, cd1) = (i32x4_shuffle::<0, 4, 1, 5>(c, d), i32x4_shuffle::<2, 6, 3, 7>(c, d));
    [
        i32x4_shuffle::<0, 1, 4, 5>(ab0, cd0),
        i32x4_shuffle::<2, 3, 6, 7>(ab0, cd0),
        i32x4_shuffle::<0, 1, 4, 5>(ab1, cd1),
        i32x4_shuffle::<2, 3, 6, 7>(ab1, cd1),
    ]
}
