//! The errors of this crate: everything is refused where a description enters, never in a step.

use std::path::PathBuf;

/// Why a hull, a hull file or a body description was refused.
#[non_exhaustive]
#[derive(Debug, thiserror::Error)]
pub enum BodyError {
    /// A number outside its bounds.
    #[error("{field} is {value}; it must be {bound}")]
    InvalidValue {
        /// Name of the field or argument.
        field: &'static str,
        /// What was found.
        value: f64,
        /// What is allowed.
        bound: &'static str,
    },
    /// A radiation table whose columns differ in length, or with too few rows.
    #[error(
        "the radiation table of {mode} has {omega} frequencies, {added} added masses and {damping} dampings; \
         all three must be equal and at least 4"
    )]
    TableRows {
        /// Heave, roll or pitch.
        mode: &'static str,
        /// Frequencies found.
        omega: usize,
        /// Added masses found.
        added: usize,
        /// Dampings found.
        damping: usize,
    },
    /// A number of a radiation table that cannot be.
    #[error("the radiation table of {mode}: {column} in row {row} is {value}; it must be {bound}")]
    TableValue {
        /// Heave, roll or pitch.
        mode: &'static str,
        /// The column.
        column: &'static str,
        /// The row, counted from 0.
        row: usize,
        /// What was found.
        value: f64,
        /// What is allowed.
        bound: &'static str,
    },
    /// A radiation table that leaves out the frequency at which the body swings.
    #[error(
        "the radiation table of {mode} reaches from {from} to {to} rad/s; the body's own frequency, {natural} rad/s, \
         must lie within"
    )]
    TableRange {
        /// Heave, roll or pitch.
        mode: &'static str,
        /// Lowest frequency, rad/s.
        from: f64,
        /// Highest frequency, rad/s.
        to: f64,
        /// The body's, with the table's added mass, rad/s.
        natural: f64,
    },
    /// A mesh without triangles, or one whose triangles are all degenerate.
    #[error(
        "the mesh has no usable triangle: {vertices} vertices, {triangles} triangles of which \
         {degenerate} are degenerate; at least 4 proper triangles are needed"
    )]
    EmptyMesh {
        /// Vertices found.
        vertices: usize,
        /// Triangles found.
        triangles: usize,
        /// Triangles with two equal corners after welding.
        degenerate: usize,
    },
    /// Vertices that are NaN, infinite or farther than 10 km from the origin.
    #[error(
        "{count} vertices are not finite or beyond 10 km from the origin, the first is number {first}; \
         coordinates are metres within +-10000"
    )]
    BadVertices {
        /// How many.
        count: usize,
        /// Index of the first.
        first: usize,
    },
    /// An index that points past the vertices, or an index list that is no multiple of three.
    #[error("triangle {triangle} uses vertex {index}, but there are {vertices} vertices (counted from 0)")]
    BadIndex {
        /// Triangle number from 0.
        triangle: usize,
        /// The offending index.
        index: usize,
        /// Vertices in the mesh.
        vertices: usize,
    },
    /// More triangles than a hull may have.
    #[error("the mesh has {triangles} triangles; at most {limit} are allowed")]
    TooManyTriangles {
        /// Triangles found.
        triangles: usize,
        /// Most that are allowed.
        limit: usize,
    },
    /// An open mesh under `Closure::Require`, or holes that a cap cannot close.
    #[error(
        "the mesh is open: {open_edges} open edges in {loops} loops; a closed mesh has none \
         (Closure::Cap closes an open top, Closure::ConvexHull wraps any mesh)"
    )]
    OpenMesh {
        /// Edges with one triangle only.
        open_edges: usize,
        /// Boundary loops they form.
        loops: usize,
    },
    /// Edges shared by three or more triangles.
    #[error(
        "{edges} edges are shared by more than two triangles; a hull is a surface with two at each \
         edge (Closure::ConvexHull wraps any mesh)"
    )]
    NonManifold {
        /// How many such edges.
        edges: usize,
    },
    /// No consistent winding exists (a Moebius strip).
    #[error("the mesh cannot be wound consistently: {edges} edges contradict; a hull has an inside and an outside")]
    NotOrientable {
        /// Contradicting edges.
        edges: usize,
    },
    /// A closed mesh that encloses (almost) nothing.
    #[error("the mesh encloses {volume} m^3; at least 1e-9 m^3 and 1e-7 of its bounding box are needed")]
    NoVolume {
        /// Enclosed volume.
        volume: f64,
    },
    /// The convex hull could not be built.
    #[error("no convex hull: {reason}")]
    ConvexHull {
        /// In words.
        reason: String,
    },
    /// The file could not be read.
    #[error("{path}: cannot be read: {source}", path = path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
    /// The file's content is not what its format allows.
    #[error("{name}: {place}: found {found}, expected {expected}")]
    Parse {
        /// The file.
        name: String,
        /// Line, byte or element.
        place: String,
        /// What is there.
        found: String,
        /// What is allowed there.
        expected: &'static str,
    },
    /// The extension names no format that is read here.
    #[error("{name}: unknown extension {found:?}; .stl, .obj, .gltf and .glb are read")]
    UnknownExtension {
        /// The file.
        name: String,
        /// Its extension, perhaps empty.
        found: String,
    },
    /// A mesh error, with the file it came from.
    #[error("{name}: {source}")]
    InFile {
        /// The file.
        name: String,
        /// The error in its mesh.
        source: Box<BodyError>,
    },
}

/// `Ok(value)` if it is finite and within the closed range.
pub(crate) fn check_range(
    field: &'static str,
    value: f32,
    min: f32,
    max: f32,
    bound: &'static str,
) -> Result<f32, BodyError> {
    if value.is_finite() && (min..=max).contains(&value) {
        Ok(value)
    } else {
        Err(BodyError::InvalidValue { field, value: f64::from(value), bound })
    }
}
