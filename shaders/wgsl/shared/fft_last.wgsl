// Last stages of small radix: butterfly m of the thread, its first twiddle at `turns`.
fn last2(v: ptr<function, Points>, m: u32, turns: u32) {
    (*v)[m + 8u] = times((*v)[m + 8u], turns_cos_sin(turns));
    radix2(v, m, m + 8u);
}

fn last4(v: ptr<function, Points>, m: u32, turns: u32) {
    (*v)[m + 4u] = times((*v)[m + 4u], turns_cos_sin(turns));
    (*v)[m + 8u] = times((*v)[m + 8u], turns_cos_sin(2u * turns));
    (*v)[m + 12u] = times((*v)[m + 12u], turns_cos_sin(3u * turns));
    radix4(v, m, m + 4u, m + 8u, m + 12u);
}

fn last8(v: ptr<function, Points>, m: u32, turns: u32) {
    (*v)[m + 2u] = times((*v)[m + 2u], turns_cos_sin(turns));
    (*v)[m + 4u] = times((*v)[m + 4u], turns_cos_sin(2u * turns));
    (*v)[m + 6u] = times((*v)[m + 6u], turns_cos_sin(3u * turns));
    (*v)[m + 8u] = times((*v)[m + 8u], turns_cos_sin(4u * turns));
    (*v)[m + 10u] = times((*v)[m + 10u], turns_cos_sin(5u * turns));
    (*v)[m + 12u] = times((*v)[m + 12u], turns_cos_sin(6u * turns));
    (*v)[m + 14u] = times((*v)[m + 14u], turns_cos_sin(7u * turns));
    radix8(v, m);
}

// Stage of radix LAST; neighbouring butterflies of a thread are 1/16 of a turn apart.
fn last_stage(v: ptr<function, Points>, turns: u32) {
    if LAST == 2u {
        last2(v, 0u, turns);
        last2(v, 1u, turns + 0x10000000u);
        last2(v, 2u, turns + 0x20000000u);
        last2(v, 3u, turns + 0x30000000u);
        last2(v, 4u, turns + 0x40000000u);
        last2(v, 5u, turns + 0x50000000u);
        last2(v, 6u, turns + 0x60000000u);
        last2(v, 7u, turns + 0x70000000u);
    } else if LAST == 4u {
        last4(v, 0u, turns);
        last4(v, 1u, turns + 0x10000000u);
        last4(v, 2u, turns + 0x20000000u);
        last4(v, 3u, turns + 0x30000000u);
    } else {
        last8(v, 0u, turns);
        last8(v, 1u, turns + 0x10000000u);
    }
}
