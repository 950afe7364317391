//! The schemes, from the cheapest per step to the highest order.

// The weights are given with the digits that were published or computed.
#![allow(clippy::excessive_precision)]

use crate::propagation::splitting::scheme::{Ends, Scheme};

/// A symmetric list of `N` weights from its first `(N + 1) / 2`.
const fn mirrored<const H: usize, const N: usize>(half: [f64; H]) -> [f64; N] {
    let mut all = [0.0; N];
    let mut i = 0;
    while i < H {
        all[i] = half[i];
        all[N - 1 - i] = half[i];
        i += 1;
    }
    all
}

/// Strang (1968): half a kick, a rotation, half a kick.
pub static STRANG: Scheme = Scheme {
    name: "strang",
    orders: [2, 2, 2],
    ends: Ends::Kicks,
    rotations: &[1.0],
    kicks: &[0.5, 0.5],
    gradients: &[],
    source: "Strang 1968, SIAM J. Numer. Anal. 5, 506",
};

/// Order 4 for Runge-Kutta-Nystrom problems (where `{V,{V,{T,V}}} = 0`) with small error constants, SRKN 6b of Blanes and Moan.
pub static SRKN_6B: Scheme = Scheme {
    name: "srkn-6b",
    orders: [4, 4, 4],
    ends: Ends::Kicks,
    rotations: &mirrored::<3, 6>([0.245298957184271, 0.604872665711080, 0.5 - (0.245298957184271 + 0.604872665711080)]),
    kicks: &mirrored::<4, 7>([
        0.0829844064174052,
        0.396309801498368,
        -0.0390563049223486,
        1.0 - 2.0 * (0.0829844064174052 + 0.396309801498368 - 0.0390563049223486),
    ]),
    gradients: &[],
    source: "Blanes and Moan 2002, J. Comput. Appl. Math. 142, 313, Table 3, SRKN 6b",
};

/// Order 6 for Runge-Kutta-Nystrom problems, SRKN 14a of Blanes and Moan.
pub static SRKN_14A: Scheme = Scheme {
    name: "srkn-14a",
    orders: [6, 6, 6],
    ends: Ends::Rotations,
    rotations: &mirrored::<8, 15>([
        0.0378593198406116,
        0.102635633102435,
        -0.0258678882665587,
        0.314241403071447,
        -0.130144459517415,
        0.106417700369543,
        -0.00879424312851058,
        1.0 - 2.0
            * (0.0378593198406116 + 0.102635633102435 - 0.0258678882665587 + 0.314241403071447 - 0.130144459517415
                + 0.106417700369543
                - 0.00879424312851058),
    ]),
    kicks: &mirrored::<7, 14>([
        0.09171915262446165,
        0.183983170005006,
        -0.05653436583288827,
        0.004914688774712854,
        0.143761127168358,
        0.328567693746804,
        0.5 - (0.09171915262446165 + 0.183983170005006 - 0.05653436583288827
            + 0.004914688774712854
            + 0.143761127168358
            + 0.328567693746804),
    ]),
    gradients: &[],
    source: "Blanes and Moan 2002, J. Comput. Appl. Math. 142, 313, Table 3, SRKN 14a",
};

/// Weights of 17 Strang steps, the first nine of a symmetric list.
const KAHAN_LI: [f64; 9] = [
    0.13020248308889008087881763,
    0.56116298177510838456196441,
    -0.38947496264484728640807860,
    0.15884190655515560089621075,
    -0.39590389413323757733623154,
    0.18453964097831570709183254,
    0.25837438768632204729397911,
    0.29501172360931029887096624,
    -0.60550853383003451169892108,
];

/// Kicks of a composition of 17 Strang steps, with neighbouring halves merged.
const fn composed_kicks() -> [f64; 18] {
    let weights: [f64; 17] = mirrored::<9, 17>(KAHAN_LI);
    let mut kicks = [0.0; 18];
    let mut i = 0;
    while i < 17 {
        kicks[i] += 0.5 * weights[i];
        kicks[i + 1] += 0.5 * weights[i];
        i += 1;
    }
    kicks
}

/// Order 8 by composition of 17 Strang steps, s17odr8a of Kahan and Li.
pub static KAHAN_LI_8: Scheme = Scheme {
    name: "kahan-li-8",
    orders: [8, 8, 8],
    ends: Ends::Kicks,
    rotations: &mirrored::<9, 17>(KAHAN_LI),
    kicks: &composed_kicks(),
    gradients: &[],
    source: "Kahan and Li 1997, Math. Comput. 66, 1089, s17odr8a",
};

/// Near-integrable (6,2): the Gauss-Legendre rule with three nodes as kicks.
pub static NEAR_INTEGRABLE_6_2: Scheme = Scheme {
    name: "near-integrable-6-2",
    orders: [6, 2, 2],
    ends: Ends::Rotations,
    rotations: &mirrored::<2, 4>([0.112_701_665_379_258_311_482_073_46, 0.387_298_334_620_741_688_517_926_54]),
    kicks: &[5.0 / 18.0, 4.0 / 9.0, 5.0 / 18.0],
    gradients: &[],
    source: "McLachlan 1995, BIT 35, 258; Laskar and Robutel 2001, Celest. Mech. Dyn. Astron. 80, 39, SABA3",
};

/// Near-integrable (10,4) of Blanes and others.
pub static NEAR_INTEGRABLE_10_4: Scheme = Scheme {
    name: "near-integrable-10-4",
    orders: [10, 4, 4],
    ends: Ends::Rotations,
    rotations: &mirrored::<4, 8>([
        0.047_067_100_645_972_506_129_478_88,
        0.184_756_935_417_088_106_924_737_62,
        0.282_706_005_679_836_205_324_361_66,
        -0.014_530_041_742_896_818_378_578_15,
    ]),
    kicks: &mirrored::<4, 7>([
        0.118_881_917_368_197_019_945_350_40,
        0.241_050_460_551_501_565_744_166_79,
        -0.273_286_666_705_323_806_054_311_40,
        0.826_708_577_571_250_440_729_588_45,
    ]),
    gradients: &[],
    source: "Blanes, Casas, Farres, Laskar, Makazaga and Murua 2013, Appl. Numer. Math. 68, 58, ABA(10,4)",
};

/// Near-integrable (8,6,4) with force gradients in four of five kicks.
pub static GRADIENT_8_6_4: Scheme = Scheme {
    name: "gradient-8-6-4",
    orders: [8, 6, 4],
    ends: Ends::Kicks,
    rotations: &mirrored::<3, 5>([
        0.168_735_950_563_437_422_448_195_2,
        0.377_851_589_220_928_303_880_768_4,
        -0.093_175_079_568_731_452_657_927_16,
    ]),
    kicks: &mirrored::<3, 6>([
        0.049_086_460_976_116_245_491_441_13,
        0.264_177_609_888_976_700_200_146_2,
        0.186_735_929_134_907_054_308_412_7,
    ]),
    gradients: &mirrored::<3, 6>([0.0, 0.000_786_358_979_595_712_102_173_260_5, 0.002_122_159_686_934_965_732_723_611]),
    source: "order conditions solved in verify/oracles/mpmath/splitting_schemes.py; the kind is that of Blanes, Casas and Ros 2000",
};

/// Near-integrable (8,6,6) with force gradients in five of seven kicks.
pub static GRADIENT_8_6_6: Scheme = Scheme {
    name: "gradient-8-6-6",
    orders: [8, 6, 6],
    ends: Ends::Kicks,
    rotations: &mirrored::<3, 6>([0.169_053_694_574_513_191_578_6, 0.403, -0.072_053_694_574_513_191_578_6]),
    kicks: &mirrored::<4, 7>([
        0.049_175_925_982_128_029_597_75,
        0.264_632_613_359_064_764_375_8,
        0.074_864_615_285_368_560_121_84,
        0.222_653_690_746_877_291_809_2,
    ]),
    gradients: &mirrored::<4, 7>([
        0.0,
        0.000_905_808_771_085_810_108_441_4,
        -0.001_347_593_687_505_283_932_062,
        0.006_653_668_931_390_292_057_946,
    ]),
    source: "order conditions solved in verify/oracles/mpmath/splitting_schemes.py; the kind is that of Blanes, Casas and Ros 2000",
};

/// Near-integrable (8,8,6) with force gradients in six of eight kicks.
pub static GRADIENT_8_8_6: Scheme = Scheme {
    name: "gradient-8-8-6",
    orders: [8, 8, 6],
    ends: Ends::Rotations,
    rotations: &mirrored::<5, 9>([
        0.068_414_050_440_850_930_811_869_61,
        0.258_225_710_440_179_217_344_324_5,
        0.454_428_506_026_815_719_187_702_1,
        -0.008_702_936_663_724_277_433_695_247,
        -0.544_730_660_488_243_179_820_402,
    ]),
    kicks: &mirrored::<4, 8>([
        0.169_736_890_340_196_459_638_304_1,
        0.350_420_193_919_583_550_151_568_9,
        0.210_576_954_182_266_612_438_657_2,
        -0.230_734_038_442_046_622_228_530_2,
    ]),
    gradients: &mirrored::<4, 8>([
        0.0,
        0.002_772_903_458_388_240_857_459_98,
        0.017_365_177_553_207_314_907_385_13,
        -0.018_476_183_761_250_380_182_645_15,
    ]),
    source: "order conditions solved in verify/oracles/mpmath/splitting_schemes.py; the kind is that of Blanes, Casas and Ros 2000",
};

/// All schemes.
pub static SCHEMES: [&Scheme; 9] = [
    &STRANG,
    &SRKN_6B,
    &SRKN_14A,
    &KAHAN_LI_8,
    &NEAR_INTEGRABLE_6_2,
    &NEAR_INTEGRABLE_10_4,
    &GRADIENT_8_6_4,
    &GRADIENT_8_6_6,
    &GRADIENT_8_8_6,
];
