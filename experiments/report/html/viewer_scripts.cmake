# The scripts of the image viewer, which the report and the live page share, in the order in which
# they stand in a page.
set(VIEWER_SCRIPTS
  decode format colour encoder planes ssim_map flip_colour flip_map errors rest_maps cache layers channels
  auto_exposure camera overlay overlay_colours gl_colours stage label painter dom svg copy at_most legend region insets
  image_list histogram rectangle rectangle_numbers rectangle_table tools commands toolbar help keys palette pointer
  view_state viewer
)
