// Box-filtered mips of a 16 x 16 block by one workgroup of 8 x 8: the block's 2 x 2 means go into `block`, and each
// `coarser` halves what is there.
var<workgroup> block: array<vec4<f32>, 64>;

// Mean of the 2 x 2 entries under entry `id` of a square of `side`.
fn mean_of_four(id: u32, side: u32) -> vec4<f32> {
    let first = (id / side) * 4u * side + (id % side) * 2u;
    let row = 2u * side;
    return 0.25 * ((block[first] + block[first + 1u]) + (block[first + row] + block[first + row + 1u]));
}

// The square of 2 side halved to `side`; entry `id` of it.
fn coarser(id: u32, side: u32) -> vec4<f32> {
    workgroupBarrier();
    let mean = mean_of_four(id % (side * side), side);
    workgroupBarrier();
    if id < side * side {
        block[id] = mean;
    }
    return mean;
}
