// Which tiles are stepped in a tick: those that are busy, with their eight neighbours, and those that the CPU forces. They
// are listed by kind, with the number of workgroups that step them; tiles to be prepared are listed once more.
override TILES_PER_GROUP: u32 = 1u;

// (column + 2^8 row + 2^16 grid, first source, number of sources, kind and flags), every tile of the tick's grids.
@group(1) @binding(0) var<storage, read> grid_tiles: array<vec4<u32>>;
@group(1) @binding(1) var<storage, read_write> grid_list: array<vec4<u32>>;
@group(1) @binding(2) var<storage, read_write> grid_counts: array<atomic<u32>>;
@group(1) @binding(3) var<storage, read_write> grid_marks: array<atomic<u32>>;

// The workgroups of a list count as those of list `dispatched`.
fn push(list: u32, dispatched: u32, per_group: u32, entry: vec4<u32>) {
    let rank = atomicAdd(&grid_counts[grid_dispatch.work + 4u * list + 3u], 1u);
    if rank % per_group == 0u {
        atomicAdd(&grid_counts[grid_dispatch.work + 4u * dispatched], 1u);
    }
    grid_list[list * grid_dispatch.count + rank] = entry;
}

@compute @workgroup_size(SCHEDULE_THREADS)
fn grid_schedule(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= grid_dispatch.count {
        return;
    }
    let tile = grid_tiles[grid_dispatch.first + id.x];
    let slot = tile.x >> 16u;
    let grid = grid_params[slot];
    let tiles = grid.torus / TILE;
    let at = vec2<u32>(tile.x & 0xffu, (tile.x >> 8u) & 0xffu);
    let before = marks_of(grid, 1u);
    let own = atomicLoad(&grid_marks[before + at.y * tiles.x + at.x]);
    var around = 0u;
    for (var k = 0u; k < 9u; k++) {
        let near = (at + tiles + vec2<u32>(k % 3u, k / 3u) - 1u) % tiles;
        around |= atomicLoad(&grid_marks[before + near.y * tiles.x + near.x]);
    }
    let busy = (around & BUSY) != 0u && grid.moved != CLEARED;
    let wanted = (busy || (tile.w & FORCED) != 0u) && (tile.w & SOLID) == 0u;
    let ending = !wanted && (own & STEPPED) != 0u;
    let prepared = ending || (wanted && (tile.z > 0u || grid.moved != STOOD));
    atomicStore(&grid_marks[marks_of(grid, 0u) + at.y * tiles.x + at.x], select(0u, STEPPED, wanted));

    // What its layer remembers is of another tile.
    let waking = (own & STEPPED) == 0u || grid.moved == CLEARED;
    let water = (tile.w & WATER) != 0u;
    let foamy = (own & FOAMED) != 0u || tile.z > 0u;
    let flags = select(0u, ENDING, ending) | select(0u, PREPARED, prepared) | select(0u, FOAMED, foamy);
    let kept = tile.w & (MIXED_TILE | FRESH_X | FRESH_Z | SLOTS_MASK);
    let entry = vec4<u32>(tile.xyz, flags | kept | select(0u, FRESH_X | FRESH_Z, waking));
    if wanted {
        atomicAdd(&grid_counts[grid_dispatch.work + ACTIVE_WORD + slot], 1u);
        // Open water, or the layer and mixed tiles.
        let general = (tile.w & MIXED_TILE) != 0u || (tile.w & SLOTS_MASK) != SLOTS_MASK;
        let dispatched = select(tile.w & KIND_MASK, WATER_LIST, water);
        push(dispatched + select(0u, 1u, water && general), dispatched, TILES_PER_GROUP, entry);
    }
    if prepared {
        let dispatched = select(PREPARE_LIST, WATER_PREPARE_LIST, water);
        push(dispatched, dispatched, 1u, entry);
    }
}
