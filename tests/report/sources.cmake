set(RL_REPORT_TESTS
  report/browser.cpp
  report/browser_test.cpp
  report/figure_test.cpp
  report/html_test.cpp
  report/model_test.cpp
  report/page.cpp
  report/painter_test.cpp
  report/pixels_test.cpp
  report/plot_test.cpp
  report/run_folder_test.cpp
  report/sample.cpp
  report/text_test.cpp
  report/viewer_test.cpp
  report/xml.cpp
  report/colour_distance.cpp
  report/tools_test.cpp
  report/error_maps_test.cpp
)
set(RL_REPORT_LIBRARIES rl_report)
# Their tests share a browser.
set(RL_REPORT_SUITES ErrorMapsTest PainterTest ReportPage RunFolder ViewerTest ViewerToolsTest)
