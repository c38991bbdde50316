// The twin of glass_ball.toml. Without a version POV-Ray 3.7 works without gamma.
global_settings { adc_bailout 1/512 max_trace_level 6 }
background { color rgb <0.45, 0.6, 0.85> }
camera { location <0, 2, 7> direction <0, -0.141421356, -0.989949494> right <0.75, 0, 0> up <0, 0.742462120, -0.106066017> }
light_source { <-4, 7, 5> color rgb 1 }
plane {
  <0, 1, 0>, 0
  texture {
    pigment { checker color rgb <0.9, 0.88, 0.8> color rgb <0.2, 0.25, 0.35> translate <0, 0.5, 0> }
    finish { ambient 0 diffuse 0.8 }
  }
}
sphere {
  <0, 1, 0>, 1
  texture {
    pigment { color rgb 1 transmit 0.85 }
    finish { ambient 0 diffuse 0 phong 0.5 phong_size 200 reflection 0.1 }
  }
  interior { ior 1.5 }
}
