# The scripts of the image viewer, which the report and the live page share, in the order in which
# they stand in a page.
set(VIEWER_SCRIPTS
  decode format colour encoder errors cache layers camera overlay overlay_colours gl_colours stage label painter dom legend
  image_list commands toolbar help keys palette pointer viewer
)
