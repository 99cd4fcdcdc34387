#include "experiments/view/view_page.h"

#include "experiments/view/assets.h"

namespace restlab {

std::string viewPage() {
  std::string page =
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<title>restlab view</title>\n<style>\n";
  page += viewStyle();
  page +=
      "</style>\n</head>\n<body>\n<noscript>The viewer is a script: allow scripts for this "
      "page.</noscript>\n<script>\n(() => {\n'use strict';\n";
  page += viewScript();
  page += "})();\n</script>\n</body>\n</html>\n";
  return page;
}

}  // namespace restlab
