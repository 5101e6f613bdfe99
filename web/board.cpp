#include "web/board.h"

#include "reports/pages/board_page.h"
#include "web/routes.h"

namespace seldinger::web {

Response show_board(Site& site, const Call& call) {
  constexpr std::string_view kName = "code=";
  const std::string_view query = call.request.query;
  if (query.substr(0, kName.size()) != kName) return html_response(200, reports::board_start_page(""));
  const auto board = site.questions.find_board(std::string(query.substr(kName.size())));
  if (!board)
    return html_response(404, reports::board_start_page("There is no workshop of that code. Is it typed right?"));
  Response response = html_response(200, reports::board_page(board->workshop, board->participants));
  response.headers.emplace_back("Refresh", std::to_string(reports::kBoardEveryS));
  return response;
}

}  // namespace seldinger::web
