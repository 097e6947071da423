//! Hull meshes from files.
