//! All tests in one binary: linking wgpu once is slow enough.

mod adaptive;
mod animate;
mod backgrounds;
mod bench;
mod bsdf;
mod bvh;
mod checkpoint;
mod cli;
mod closed_mirrors;
mod contact;
mod coverage;
mod deformation;
mod denoise;
mod difference;
mod distribution;
mod drivers;
mod embed;
mod endings;
mod environment;
mod examples;
mod explain;
mod export;
mod exposure;
mod faults;
mod features;
mod film;
mod film_files;
mod fingerprints;
mod fuzz;
mod golden;
mod import;
mod imports;
mod inputs;
mod instances;
mod kernels;
mod layers;
mod layout;
mod lens;
mod levels;
mod manual;
mod messages;
mod mipmaps;
mod models;
mod motion_blur;
mod moving;
mod moving_pictures;
mod normal_maps;
mod optics;
mod orthographic;
mod output;
mod pack;
mod pack_again;
mod pack_view;
mod path;
mod pictures;
mod ray_offset;
mod ray_query;
mod readme;
mod reference;
mod render;
mod sampling;
mod scale;
mod scene;
mod scene_animation;
mod scene_motion;
mod scene_turntable;
mod shader_albedo;
mod shader_area_light;
mod shader_camera;
mod shader_canonical;
mod shader_colormap;
mod shader_dispersion;
mod shader_filter;
mod shader_fresnel;
mod shader_globe;
mod shader_library;
mod shader_light;
mod shader_media;
mod shader_mis;
mod shader_motion;
mod shader_node;
mod shader_numeric;
mod shader_offset;
mod shader_pattern;
mod shader_phong;
mod shader_picture;
mod shader_plane;
mod shader_quad_warp;
mod shader_ray_cone;
mod shader_rng;
mod shader_sampling;
mod shader_sphere;
mod shader_spherical_rectangle;
mod shader_thin_film;
mod shader_tile;
mod shader_tone;
mod shader_triangles;
mod shader_warp;
mod soft_shadows;
mod spd;
mod support;
mod tangents;
mod textures;
mod thin_walls;
mod trees;
mod uv_view;
#[cfg(feature = "video")]
mod video;
#[cfg(feature = "viewer")]
mod view;
#[cfg(feature = "viewer")]
mod view_bindings;
#[cfg(feature = "viewer")]
mod view_command_line;
#[cfg(feature = "viewer")]
mod view_document;
#[cfg(feature = "viewer")]
mod view_handles;
#[cfg(feature = "viewer")]
mod view_histogram;
#[cfg(feature = "viewer")]
mod view_navigation;
#[cfg(feature = "viewer")]
mod view_objects;
#[cfg(feature = "viewer")]
mod view_preferences;
